#include "client/connection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/failure.h"

namespace rollgait::client {
namespace {

GlobalOptions WithToken(const std::string& server) {
  GlobalOptions options;
  options.server = server;
  options.token = "secret";
  options.insecure = true;
  return options;
}

TEST(Connection, TokenGoesInPlainTextToThisMachineAlone) {
  for (const char* local : {"127.0.0.1:1", "127.8.9.1:1", "localhost:1", "[::1]:1", "unix:/tmp/socket"}) {
    EXPECT_NO_THROW(Connection{WithToken(local)}) << local;
  }
  for (const char* far : {"example.org:1", "127.example.org:1", "127.0.0.1.example.org:1", "localhost.example.org:1",
                          "128.0.0.1:1", "[::2]:1"}) {
    EXPECT_THROW(Connection{WithToken(far)}, Failure) << far;
  }
}

}  // namespace
}  // namespace rollgait::client
