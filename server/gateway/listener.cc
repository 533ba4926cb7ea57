#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/gateway/http_server.h"

namespace rollgait::server {
namespace {

Error CannotListen(const std::string& listen, const std::string& reason) {
  return {ErrorCode::kUnavailable, "cannot listen on " + listen + ": " + reason};
}

Outcome<int> OpenUnix(const std::string& listen) {
  const std::string path = listen.substr(5);
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof name.sun_path) return CannotListen(listen, "the path is empty or too long");
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
  if (bound && ::listen(fd, 128) == 0) return fd;
  close(fd);
  return CannotListen(listen, std::strerror(failure));
}

std::string AddressOf(int fd) {
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

}  // namespace

Outcome<int> OpenListener(const std::string& listen, std::string* address) {
  *address = listen;
  if (listen.rfind("unix:", 0) == 0) return OpenUnix(listen);
  const size_t colon = listen.rfind(':');
  if (colon == std::string::npos) return CannotListen(listen, "it must be HOST:PORT or unix:PATH");
  std::string host = listen.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  if (const int failure = getaddrinfo(host.c_str(), listen.c_str() + colon + 1, &hints, &found); failure != 0) {
    return CannotListen(listen, gai_strerror(failure));
  }
  const int fd = socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const bool bound = bind(fd, found->ai_addr, found->ai_addrlen) == 0 && ::listen(fd, 128) == 0;
  const int failure = errno;
  freeaddrinfo(found);
  if (!bound) {
    close(fd);
    return CannotListen(listen, std::strerror(failure));
  }
  *address = AddressOf(fd);
  return fd;
}

}  // namespace rollgait::server
