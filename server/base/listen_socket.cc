#include "server/base/listen_socket.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "server/base/listen_address.h"

namespace rollgait::server {
namespace {

constexpr int kBacklog = 512;

Error CannotListen(const std::string& address, const std::string& reason) {
  return {ErrorCode::kUnavailable, "cannot listen on " + address + ": " + reason};
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

}  // namespace

Outcome<TcpListeners> ListenOnTcp(const std::string& address, size_t most) {
  const size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon + 1 == address.size()) return CannotListen(address, "it is not HOST:PORT");
  const std::string named = HostOf(address), host = named == "*" ? "" : named;
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  const int code = getaddrinfo(host.empty() ? nullptr : host.c_str(), address.c_str() + colon + 1, &hints, &found);
  if (code != 0) return CannotListen(address, gai_strerror(code));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> list(found, freeaddrinfo);
  std::string reason = "no address";
  // An IPv6 wildcard takes IPv4 along, so it goes first and the IPv4 wildcard may then be taken.
  std::vector<const addrinfo*> order;
  for (const addrinfo* info = found; info != nullptr; info = info->ai_next) order.push_back(info);
  if (host.empty()) {
    std::stable_sort(order.begin(), order.end(),
                     [](auto* a, auto* b) { return a->ai_family == AF_INET6 && b->ai_family != AF_INET6; });
  }
  TcpListeners listeners;
  for (const addrinfo* info : order) {
    if (listeners.fds.size() == most) break;
    const int fd = ListenOn(*info, listeners.port);
    if (fd < 0) {
      reason = std::strerror(errno);
      // A machine without IPv6 still has "localhost" twice; but an address in use is never passed over.
      if (errno != EADDRINUSE || (host.empty() && !listeners.fds.empty())) continue;
      for (const int open : listeners.fds) close(open);
      return CannotListen(address, reason);
    }
    listeners.fds.push_back(fd);
    listeners.port = PortOf(fd);
  }
  if (listeners.fds.empty()) return CannotListen(address, reason);
  return listeners;
}

Outcome<int> ListenOnUnix(const std::string& path) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof name.sun_path) {
    return CannotListen("unix:" + path, "the path is empty or too long");
  }
  std::memcpy(name.sun_path, path.c_str(), path.size() + 1);
  const auto* address = reinterpret_cast<const sockaddr*>(&name);
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool is_left_over = connect(probe, address, sizeof name) != 0 && errno == ECONNREFUSED;
  close(probe);
  if (is_left_over) unlink(path.c_str());
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  // From the first moment on the group's alone.
  const mode_t mask = umask(0117);
  const bool bound = bind(fd, address, sizeof name) == 0;
  const int failure = errno;
  umask(mask);
  if (bound && listen(fd, kBacklog) == 0) return fd;
  close(fd);
  return CannotListen("unix:" + path, std::strerror(failure));
}

std::string BoundAddress(int fd) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  char host[NI_MAXHOST], port[NI_MAXSERV];
  if (getsockname(fd, reinterpret_cast<sockaddr*>(&name), &size) != 0 ||
      getnameinfo(reinterpret_cast<sockaddr*>(&name), size, host, sizeof host, port, sizeof port,
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "";
  }
  const std::string text = host;
  return (text.find(':') == std::string::npos ? text : "[" + text + "]") + ":" + port;
}

std::string PeerKey(const sockaddr_storage& address) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address.ss_family == AF_UNIX) return "unix";
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

std::string PeerKey(const std::string& peer) {
  const std::string host = HostOf(peer.substr(peer.find(':') + 1));
  sockaddr_storage address{};
  if (peer.rfind("ipv4:", 0) == 0 &&
      inet_pton(AF_INET, host.c_str(), &reinterpret_cast<sockaddr_in&>(address).sin_addr) == 1) {
    address.ss_family = AF_INET;
    return PeerKey(address);
  }
  if (peer.rfind("ipv6:", 0) == 0 &&
      inet_pton(AF_INET6, host.c_str(), &reinterpret_cast<sockaddr_in6&>(address).sin6_addr) == 1) {
    address.ss_family = AF_INET6;
    return PeerKey(address);
  }
  return peer;
}

}  // namespace rollgait::server
