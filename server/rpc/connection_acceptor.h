#ifndef ROLLGAIT_SERVER_RPC_CONNECTION_ACCEPTOR_H_
#define ROLLGAIT_SERVER_RPC_CONNECTION_ACCEPTOR_H_

#include <grpcpp/server_builder.h>
#include <sys/socket.h>
#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/base/outcome.h"

namespace rollgait::server {

struct ConnectionLimits {
  int total = 0;  // 0: what the limit of descriptors leaves beside those the server needs itself
  int per_peer =
      0;  // from one IPv4 address or one IPv6 /64 network; 0: half of all, so that no one keeps all others out
};

// Listens and accepts in gRPC's place, and hands connections over. gRPC 1.51 stops accepting for ever when descriptors
// run out (CVE-2023-4785), and has no limit of connections; here a connection beyond the limits is closed at once, and
// running out of descriptors is survived.
class ConnectionAcceptor {
 public:
  // Listens on every address of "HOST:PORT"; port 0: any free one, the same on all. kUnavailable with the reason.
  static Outcome<std::unique_ptr<ConnectionAcceptor>> Listen(const std::string& address,
                                                             const ConnectionLimits& limits);
  ~ConnectionAcceptor();
  ConnectionAcceptor(const ConnectionAcceptor&) = delete;
  ConnectionAcceptor& operator=(const ConnectionAcceptor&) = delete;

  int port() const { return port_; }
  int limit() const { return limits_.total; }
  // Accepts from now on; the gRPC server has been started.
  void Start(std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> grpc);
  // Accepts nothing more and closes the listening sockets. Connections stay.
  void Stop();

 private:
  // A socket given to gRPC. It is gone when its number stands for another file or none.
  struct Connection {
    int fd;
    ino_t inode;
    std::string peer;
  };

  explicit ConnectionAcceptor(const ConnectionLimits& limits);
  void Loop();
  // False: nothing waits on this listener.
  bool AcceptOne(int listener);
  void Take(int listener, int fd, const std::string& peer);
  void RefuseWithReserve(int listener);
  void ForgetClosed();
  bool HasRoom(const std::string& peer);
  void LogRefusals();

  ConnectionLimits limits_;
  std::vector<int> listeners_;
  int port_ = 0;
  int reserve_fd_ = -1;  // given up for a moment to accept and close when there are no descriptors
  int stop_fd_ = -1;
  std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> grpc_;
  std::vector<Connection> connections_;  // some are closed, until the next sweep
  size_t sweep_at_ = 1024;
  std::map<std::string, int> of_peer_;
  int64_t refused_ = 0;
  std::chrono::steady_clock::time_point last_swept_, last_logged_;
  std::thread thread_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_CONNECTION_ACCEPTOR_H_
