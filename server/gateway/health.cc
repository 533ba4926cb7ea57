#include "server/gateway/health.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/base/listen_address.h"

namespace rollgait::server {
namespace {

constexpr timeval kPatience{4, 0};  // for each of connecting, writing and reading
constexpr char kRequest[] = "HEAD /v1/openapi.json HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

int ConnectTo(const sockaddr* address, socklen_t size) {
  const int fd = socket(address->sa_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  if (connect(fd, address, size) == 0) return fd;
  const int reason = errno;
  close(fd);
  errno = reason;
  return -1;
}

int ConnectTo(const std::string& listen) {
  if (listen.rfind("unix:", 0) == 0) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    listen.copy(name.sun_path, sizeof name.sun_path - 1, 5);
    return ConnectTo(reinterpret_cast<const sockaddr*>(&name), sizeof name);
  }
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  const std::string host = HostOf(listen), port = listen.substr(listen.rfind(':') + 1);
  const bool is_any = host.empty() || host == "*";  // this machine's loopback is among them
  if (getaddrinfo(is_any ? nullptr : host.c_str(), port.c_str(), &hints, &found) != 0) {
    errno = EADDRNOTAVAIL;
    return -1;
  }
  int fd = -1;
  for (const addrinfo* info = found; info != nullptr && fd < 0; info = info->ai_next) {
    fd = ConnectTo(info->ai_addr, info->ai_addrlen);
  }
  freeaddrinfo(found);
  return fd;
}

}  // namespace

Outcome<Done> AskForHealth(const std::string& listen) {
  const int fd = ConnectTo(listen);
  const auto problem = [&](const std::string& why) {
    return Error{ErrorCode::kUnavailable, "the gateway at " + listen + " does not answer: " + why};
  };
  if (fd < 0) return problem(std::strerror(errno));
  std::string answer;
  char bytes[512];
  ssize_t count = send(fd, kRequest, sizeof kRequest - 1, MSG_NOSIGNAL);
  while (count > 0 && answer.size() < 12 && (count = recv(fd, bytes, sizeof bytes, 0)) > 0) {
    answer.append(bytes, static_cast<size_t>(count));
  }
  const std::string reason = count < 0 ? std::strerror(errno) : "it answers " + answer.substr(0, answer.find('\r'));
  close(fd);
  if (answer.rfind("HTTP/1.1 200", 0) != 0) return problem(reason);
  return Done{};
}

}  // namespace rollgait::server
