#ifndef ROLLGAIT_SERVER_BASE_LISTEN_SOCKET_H_
#define ROLLGAIT_SERVER_BASE_LISTEN_SOCKET_H_

#include <sys/socket.h>

#include <cstddef>
#include <string>
#include <vector>

#include "server/base/outcome.h"

namespace rollgait::server {

struct TcpListeners {
  std::vector<int> fds;  // at least one; whoever has them closes them
  int port = 0;          // of all of them
};

// Listens on the addresses that HOST of "HOST:PORT" stands for, on the first `most` that can be had; "*" and "" are
// every address, port 0 is any free one. The sockets do not block and are closed by exec. kUnavailable with the reason.
Outcome<TcpListeners> ListenOnTcp(const std::string& address, size_t most);

// Listens on a unix socket of mode 0660; one that nobody listens on any more is replaced. kUnavailable with the reason.
Outcome<int> ListenOnUnix(const std::string& path);

// "HOST:PORT" that a socket is bound to, in numbers; empty: it is no socket of TCP.
std::string BoundAddress(int fd);

// Who is counted as one: an IPv4 address, an IPv6 /64; "unix" for a unix socket.
std::string PeerKey(const sockaddr_storage& address);
// The same of "ipv4:192.0.2.1:4711" and "ipv6:[2001:db8::1]:4711", as the door and gRPC say it; another text is itself.
std::string PeerKey(const std::string& peer);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LISTEN_SOCKET_H_
