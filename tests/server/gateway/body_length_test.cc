#include "server/gateway/body_length.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace rollgait::server {
namespace {

BodyLength Of(const std::map<std::string, std::string>& headers) {
  HttpRequest head;
  head.headers = headers;
  return BodyLengthOf(head, 1000);
}

TEST(BodyLengthTest, OneLengthIsTaken) {
  EXPECT_EQ(Of({}).bytes, 0u);
  EXPECT_EQ(Of({}).status, 0);
  EXPECT_EQ(Of({{"content-length", "0"}}).bytes, 0u);
  EXPECT_EQ(Of({{"content-length", "1000"}}).bytes, 1000u);
  EXPECT_EQ(Of({{"content-length", "1000"}}).status, 0);
}

TEST(BodyLengthTest, TwoLengthsAreRefused) {
  EXPECT_EQ(Of({{"content-length", "5"}, {"transfer-encoding", "chunked"}}).status, 400);
  EXPECT_EQ(Of({{"content-length", "5"}, {"transfer-encoding", "identity"}}).status, 400);
  EXPECT_EQ(Of({{"transfer-encoding", "chunked"}}).status, 411);
  EXPECT_EQ(Of({{"transfer-encoding", ""}}).status, 411);
}

TEST(BodyLengthTest, WhatIsNoNumberIsRefused) {
  for (const char* text : {"", " ", "-1", "+1", "1 ", "0x10", "1.5", "1e3", "5, 5", "99999999999999999999 "}) {
    EXPECT_EQ(Of({{"content-length", text}}).status, 400) << '"' << text << '"';
  }
}

TEST(BodyLengthTest, TooLongIsRefusedWithTheLimit) {
  for (const char* text : {"1001", "18446744073709551615", "18446744073709551616", "99999999999999999999999999"}) {
    const BodyLength length = Of({{"content-length", text}});
    EXPECT_EQ(length.status, 413) << text;
    EXPECT_EQ(length.message, std::string("the body has ") + text + " bytes, the limit is 1000");
  }
}

}  // namespace
}  // namespace rollgait::server
