#include "server/base/listen_socket.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

TEST(ListenSocket, APeerIsAnAddressOrANetwork) {
  EXPECT_EQ(PeerKey("ipv4:192.0.2.1:4711"), "192.0.2.1");
  EXPECT_EQ(PeerKey("ipv6:[2001:db8:0:1:2:3:4:5]:4711"), "2001:db8:0:1::/64");
  EXPECT_EQ(PeerKey("ipv6:[::ffff:192.0.2.1]:1"), "192.0.2.1");
  EXPECT_EQ(PeerKey("whoever"), "whoever");
  EXPECT_EQ(PeerKey(""), "");
  sockaddr_storage address{};
  address.ss_family = AF_UNIX;
  EXPECT_EQ(PeerKey(address), "unix");
}

TEST(ListenSocket, TcpHasOnePortAndSaysWhichItIs) {
  const TcpListeners listeners = ListenOnTcp("127.0.0.1:0", 5).value();
  ASSERT_EQ(listeners.fds.size(), 1u);
  const std::string address = "127.0.0.1:" + std::to_string(listeners.port);
  EXPECT_EQ(BoundAddress(listeners.fds[0]), address);
  EXPECT_THAT(ListenOnTcp(address, 1).error().message, HasSubstr("in use"));
  EXPECT_THAT(ListenOnTcp("127.0.0.1", 1).error().message, HasSubstr("HOST:PORT"));
  EXPECT_THAT(ListenOnTcp("127.0.0.1:", 1).error().message, HasSubstr("HOST:PORT"));
  close(listeners.fds[0]);
}

TEST(ListenSocket, AUnixSocketIsTheGroupsAndReplacesWhatIsLeft) {
  const TemporaryDirectory directory;
  const std::string path = directory.path() + "/a.sock";
  const int fd = ListenOnUnix(path).value();
  struct stat info {};
  ASSERT_EQ(stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0660u);
  EXPECT_THAT(ListenOnUnix(path).error().message, HasSubstr("in use"));
  close(fd);
  const Outcome<int> next = ListenOnUnix(path);
  ASSERT_TRUE(next.ok());
  close(next.value());
  EXPECT_THAT(ListenOnUnix(directory.path() + "/" + std::string(200, 'a')).error().message, HasSubstr("too long"));
}

}  // namespace
}  // namespace rollgait::server
