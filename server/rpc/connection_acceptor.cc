#include "server/rpc/connection_acceptor.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
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
#include <cstring>
#include <utility>

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

// Who is counted as one: an IPv4 address, an IPv6 /64.
std::string PeerKey(const sockaddr_storage& address) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address.ss_family == AF_INET) {
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in&>(address).sin_addr, text, sizeof(text));
    return text;
  }
  in6_addr network = reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
  if (IN6_IS_ADDR_V4MAPPED(&network)) {
    inet_ntop(AF_INET, network.s6_addr + 12, text, sizeof(text));
    return text;
  }
  std::fill(network.s6_addr + 8, network.s6_addr + 16, uint8_t{0});
  inet_ntop(AF_INET6, &network, text, sizeof(text));
  return std::string(text) + "/64";
}

// HOST and PORT of "HOST:PORT"; brackets around an IPv6 address are taken off, "*" is every address.
std::pair<std::string, std::string> Split(const std::string& address) {
  const size_t colon = address.rfind(':');
  if (colon == std::string::npos) return {address, ""};
  std::string host = address.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return {host == "*" ? "" : host, address.substr(colon + 1)};
}

int ListenOn(const addrinfo& info, int port) {
  sockaddr_storage address{};
  std::memcpy(&address, info.ai_addr, info.ai_addrlen);
  if (port != 0 && info.ai_family == AF_INET)
    reinterpret_cast<sockaddr_in&>(address).sin_port = htons(static_cast<uint16_t>(port));
  if (port != 0 && info.ai_family == AF_INET6)
    reinterpret_cast<sockaddr_in6&>(address).sin6_port = htons(static_cast<uint16_t>(port));
  const int fd = socket(info.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1, off = 0;
  if (fd < 0) return -1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (info.ai_family == AF_INET6) setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof(off));
  if (bind(fd, reinterpret_cast<sockaddr*>(&address), info.ai_addrlen) == 0 && listen(fd, kBacklog) == 0) return fd;
  const int reason = errno;
  close(fd);
  errno = reason;
  return -1;
}

int PortOf(int fd) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.ss_family == AF_INET ? reinterpret_cast<sockaddr_in&>(address).sin_port
                                            : reinterpret_cast<sockaddr_in6&>(address).sin6_port);
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
  const Outcome<Done> bound = acceptor->Bind(address);
  if (!bound.ok()) return bound.error();
  return acceptor;
}

Outcome<Done> ConnectionAcceptor::Bind(const std::string& address) {
  const auto refuse = [&](const std::string& reason) {
    return Error{ErrorCode::kUnavailable, "cannot listen on " + address + ": " + reason};
  };
  const auto [host, port] = Split(address);
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  const int code =
      port.empty() ? EAI_NONAME : getaddrinfo(host.empty() ? nullptr : host.c_str(), port.c_str(), &hints, &found);
  if (code != 0) return refuse(port.empty() ? "it is not HOST:PORT" : gai_strerror(code));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> list(found, freeaddrinfo);
  std::string reason = "no address";
  // An IPv6 wildcard takes IPv4 along, so it goes first and the IPv4 wildcard may then be taken.
  std::vector<const addrinfo*> order;
  for (const addrinfo* info = found; info != nullptr; info = info->ai_next) order.push_back(info);
  if (host.empty()) {
    std::stable_sort(order.begin(), order.end(),
                     [](auto* a, auto* b) { return a->ai_family == AF_INET6 && b->ai_family != AF_INET6; });
  }
  for (const addrinfo* info : order) {
    const int fd = ListenOn(*info, port_);
    if (fd < 0) {
      reason = std::strerror(errno);
      // A machine without IPv6 still has "localhost" twice; but an address in use is never passed over.
      if (errno == EADDRINUSE && !(host.empty() && !listeners_.empty())) return refuse(reason);
      continue;
    }
    listeners_.push_back(fd);
    port_ = PortOf(fd);
  }
  if (listeners_.empty()) return refuse(reason);
  return Done{};
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
