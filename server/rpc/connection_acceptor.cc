#include "server/rpc/connection_acceptor.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <utility>

#include "server/base/listen_socket.h"

namespace rollgait::server {
namespace {

using SteadyClock = std::chrono::steady_clock;

// Descriptors that the server itself may need: the store's connections, agents, simulations, logs.
constexpr int kOwnDescriptors = 96;
constexpr int kBacklog = 512;
constexpr int kUserTimeoutMillis = 30'000;
constexpr std::chrono::milliseconds kSweepPause{100};

int DescriptorLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 1024;
  return static_cast<int>(std::min<rlim_t>(limit.rlim_cur, 1 << 20));
}

int OpenReserve() { return open("/dev/null", O_RDONLY | O_CLOEXEC); }

}  // namespace

ConnectionAcceptor::ConnectionAcceptor(const ConnectionLimits& limits)
    : limits_(limits), reserve_fd_(OpenReserve()), stop_fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  const int room = std::max(16, DescriptorLimit() - kOwnDescriptors);
  limits_.total = limits.total > 0 ? std::min(limits.total, room) : room;
  if (limits_.per_peer <= 0) limits_.per_peer = std::max(1, limits_.total / 2);
}

ConnectionAcceptor::~ConnectionAcceptor() {
  Stop();
  if (reserve_fd_ >= 0) close(reserve_fd_);
  if (stop_fd_ >= 0) close(stop_fd_);
}

Outcome<std::unique_ptr<ConnectionAcceptor>> ConnectionAcceptor::Listen(const std::string& address,
                                                                        const ConnectionLimits& limits) {
  std::unique_ptr<ConnectionAcceptor> acceptor(new ConnectionAcceptor(limits));
  Outcome<TcpListeners> listeners = ListenOnTcp(address, SIZE_MAX);
  if (!listeners.ok()) return listeners.error();
  acceptor->listeners_ = std::move(listeners.value().fds);
  acceptor->port_ = listeners.value().port;
  return acceptor;
}

void ConnectionAcceptor::Start(std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> grpc) {
  grpc_ = std::move(grpc);
  thread_ = std::thread([this] { Loop(); });
}

void ConnectionAcceptor::Stop() {
  if (thread_.joinable()) {
    eventfd_write(stop_fd_, 1);
    thread_.join();
  }
  for (const int listener : std::exchange(listeners_, {})) close(listener);
}

void ConnectionAcceptor::Loop() {
  std::vector<pollfd> entries = {{stop_fd_, POLLIN, 0}};
  for (const int listener : listeners_) entries.push_back({listener, POLLIN, 0});
  while (true) {
    poll(entries.data(), entries.size(), -1);
    if (entries[0].revents != 0) return;
    for (size_t i = 1; i < entries.size(); ++i) {
      if (entries[i].revents == 0) continue;
      // As many as came together, then the others' turn and a look at the stop.
      for (int count = 0; count < kBacklog && AcceptOne(entries[i].fd); ++count) {
      }
    }
  }
}

bool ConnectionAcceptor::AcceptOne(int listener) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  const int fd = accept4(listener, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd >= 0) {
    Take(listener, fd, PeerKey(address));
    return true;
  }
  switch (errno) {
    case EMFILE:
    case ENFILE:
    case ENOBUFS:
    case ENOMEM:
      RefuseWithReserve(listener);
      return false;
    case EAGAIN:
      return false;
    default:
      return true;  // that connection is gone; the next one
  }
}

void ConnectionAcceptor::Take(int listener, int fd, const std::string& peer) {
  struct stat info {};
  if (!HasRoom(peer) || fstat(fd, &info) != 0) {
    close(fd);
    ++refused_;
    LogRefusals();
    return;
  }
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  setsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &kUserTimeoutMillis, sizeof(kUserTimeoutMillis));
  if (connections_.size() >= sweep_at_) {
    ForgetClosed();
    sweep_at_ = std::max<size_t>(1024, 2 * connections_.size());
  }
  connections_.push_back({fd, info.st_ino, peer});
  ++of_peer_[peer];
  grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters connection;
  connection.listener_fd = listener;
  connection.fd = fd;
  grpc_->HandleNewConnection(&connection);
}

bool ConnectionAcceptor::HasRoom(const std::string& peer) {
  const auto full = [&] {
    const auto count = of_peer_.find(peer);
    return static_cast<int>(connections_.size()) >= limits_.total ||
           (count != of_peer_.end() && count->second >= limits_.per_peer);
  };
  if (!full()) return true;
  if (SteadyClock::now() - last_swept_ < kSweepPause) return false;
  ForgetClosed();
  return !full();
}

void ConnectionAcceptor::ForgetClosed() {
  last_swept_ = SteadyClock::now();
  const auto closed = [](const Connection& connection) {
    struct stat info {};
    return fstat(connection.fd, &info) != 0 || info.st_ino != connection.inode || !S_ISSOCK(info.st_mode);
  };
  connections_.erase(std::remove_if(connections_.begin(), connections_.end(), closed), connections_.end());
  of_peer_.clear();
  for (const Connection& connection : connections_) ++of_peer_[connection.peer];
}

void ConnectionAcceptor::RefuseWithReserve(int listener) {
  if (reserve_fd_ >= 0) close(std::exchange(reserve_fd_, -1));
  const int fd = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
  if (fd >= 0) close(fd);
  reserve_fd_ = OpenReserve();
  ++refused_;
  LogRefusals();
  // Others may free descriptors; meanwhile the rest waits in the kernel.
  pollfd stop{stop_fd_, POLLIN, 0};
  poll(&stop, 1, 5);
}

void ConnectionAcceptor::LogRefusals() {
  if (SteadyClock::now() - last_logged_ < std::chrono::seconds(10)) return;
  last_logged_ = SteadyClock::now();
  spdlog::warn("{} connections were closed at once so far: {} are open, the limit is {}, {} from one address", refused_,
               connections_.size(), limits_.total, limits_.per_peer);
}

}  // namespace rollgait::server
