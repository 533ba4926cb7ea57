#include "server/base/listen_address.h"

#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

TEST(ListenAddress, HostIsWithoutPortAndBrackets) {
  EXPECT_EQ(HostOf("localhost:50051"), "localhost");
  EXPECT_EQ(HostOf("localhost"), "localhost");
  EXPECT_EQ(HostOf("127.0.0.1:0"), "127.0.0.1");
  EXPECT_EQ(HostOf("[::1]:5"), "::1");
  EXPECT_EQ(HostOf("[::1]"), "::1");
  EXPECT_EQ(HostOf(""), "");
}

TEST(ListenAddress, KnowsLoopbackAddresses) {
  for (const char* local : {"127.0.0.1:1", "127.9.9.9:0", "localhost:50051", "[::1]:5", "unix:/tmp/socket"}) {
    EXPECT_TRUE(IsLoopback(local)) << local;
  }
  for (const char* open : {"0.0.0.0:1", "[::]:1", "192.168.0.1:1", "example.org:1", "128.0.0.1:1", "*:1", ":1", "",
                           "127.example.org:1", "127.0.0.1.example.org:1", "localhost.example.org:1", "127.1:1"}) {
    EXPECT_FALSE(IsLoopback(open)) << open;
  }
}

TEST(ListenAddress, NoHostIsASocketOfTheFileSystem) {
  EXPECT_TRUE(IsLoopbackHost("localhost"));
  EXPECT_TRUE(IsLoopbackHost("LocalHost"));
  EXPECT_TRUE(IsLoopbackHost("::1"));
  EXPECT_FALSE(IsLoopbackHost("LocalHosts"));
  EXPECT_FALSE(IsLoopbackHost("unix"));
  EXPECT_FALSE(IsLoopbackHost("unix:/tmp/socket"));
}

}  // namespace
}  // namespace rollgait::server
