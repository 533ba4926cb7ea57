// What a server that asks for certificates and tokens offers beside the methods that ask.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "tests/e2e/guarded_server.h"
#include "tests/support/scrape.h"

namespace rollgait::server {
namespace {

using grpc::StatusCode;
using DoorsTest = GuardedServer;

TEST_F(DoorsTest, ServicesThatAskForNoTokenAreNotOnThePublicPort) {
  // Each is answered on the administration socket: the names are right.
  const auto admin = grpc::CreateChannel("unix:" + path("data") + "/admin.sock", grpc::InsecureChannelCredentials());
  for (const char* method : {"/grpc.health.v1.Health/Check", "/grpc.health.v1.Health/Watch",
                             "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
                             "/grpc.channelz.v1.Channelz/GetServers", "/grpc.channelz.v1.Channelz/GetTopChannels"}) {
    for (const Visitor& visitor : strangers_) EXPECT_EQ(Call(visitor, method, ""), StatusCode::UNAVAILABLE) << method;
    for (const Visitor& visitor : unknown_) EXPECT_EQ(Call(visitor, method, ""), StatusCode::UNIMPLEMENTED) << method;
    EXPECT_EQ(Call(good_, method, ""), StatusCode::UNIMPLEMENTED) << method;
    EXPECT_EQ(Call(admin, "", method, ""), StatusCode::OK) << method;
  }
  // And nothing of what the public port serves is there without a token.
  EXPECT_EQ(Call(admin, "", "/rollgait.v1.GaitService/GetServerInfo", ""), StatusCode::UNIMPLEMENTED);
}

// Whether this thread may connect to a socket's file after it has become another user. Only root can become one.
bool AnotherUserConnects(const std::string& socket_path) {
  bool connected = false;
  // The system call changes this thread's user and nobody else's.
  std::thread([&] {
    if (syscall(SYS_setresuid, 65534, 65534, 65534) != 0) return;
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    socket_path.copy(to.sun_path, sizeof to.sun_path - 1);
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    connected = connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
    close(fd);
  }).join();
  return connected;
}

TEST_F(DoorsTest, TheAdministrationSocketIsItsOwnersAlone) {
  const std::string socket_path = path("data") + "/admin.sock";
  struct stat socket_is {
  }, folder_is{};
  ASSERT_EQ(stat(socket_path.c_str(), &socket_is), 0);
  ASSERT_EQ(stat(path("data").c_str(), &folder_is), 0);
  EXPECT_EQ(socket_is.st_mode & 0777, 0600u);
  EXPECT_EQ(folder_is.st_mode & 0777, 0700u);
  EXPECT_EQ(socket_is.st_uid, geteuid());
  EXPECT_EQ(folder_is.st_uid, geteuid());
  if (geteuid() != 0) GTEST_SKIP() << "only root can try it as another user";
  // The folder alone would keep him out: the socket's own mode is what is tried.
  ASSERT_EQ(chmod(path("data").c_str(), 0755), 0);
  ASSERT_EQ(chmod(directory_.path().c_str(), 0755), 0);
  EXPECT_FALSE(AnotherUserConnects(socket_path));
  ASSERT_EQ(chmod(socket_path.c_str(), 0666), 0);
  EXPECT_TRUE(AnotherUserConnects(socket_path)) << "the check above says nothing: he cannot get here at all";
}

// TCP ports on which a process listens.
std::set<int> ListeningPorts(pid_t pid) {
  std::set<std::string> sockets;  // inodes
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/fd")) {
    std::error_code gone;
    const std::string to = std::filesystem::read_symlink(entry.path(), gone);
    if (to.rfind("socket:[", 0) == 0) sockets.insert(to.substr(8, to.size() - 9));
  }
  std::set<int> ports;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream file(table);
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string number, local, remote, state, skipped, inode;
      words >> number >> local >> remote >> state;
      for (int i = 0; i < 5; ++i) words >> skipped;
      words >> inode;
      if (state == "0A" && sockets.count(inode) != 0)
        ports.insert(std::stoi(local.substr(local.rfind(':') + 1), nullptr, 16));
    }
  }
  return ports;
}

TEST_F(DoorsTest, ThereIsNoOtherDoorAndMetricsNameNobody) {
  const auto port_of = [](const std::string& address) { return std::stoi(address.substr(address.rfind(':') + 1)); };
  const std::string solve = EndedSolve();
  std::ifstream log(path("log"));
  std::string metrics;
  for (std::string line; std::getline(log, line);) {
    const size_t event = line.find("\"metrics.served\""), address = line.find("127.0.0.1:");
    if (event != std::string::npos && address != std::string::npos)
      metrics = line.substr(address, line.find('"', address) - address);
  }
  ASSERT_NE(metrics, "");
  EXPECT_EQ(ListeningPorts(daemon_->pid()), (std::set<int>{port_of(daemon_->address()), port_of(metrics)}));
  const std::string text = Scrape(metrics);
  EXPECT_NE(text.find("rollgait_solves_created_total"), std::string::npos);
  for (const std::string& secret : {std::string("acme"), std::string("rival"), solve.substr(sizeof("solves/") - 1),
                                    good_.token.substr(4, 16), good_.token.substr(20)}) {
    EXPECT_EQ(text.find(secret), std::string::npos) << secret;
  }
}

}  // namespace
}  // namespace rollgait::server
