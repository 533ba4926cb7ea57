#include "server/base/listen_address.h"

#include <arpa/inet.h>
#include <strings.h>

namespace rollgait::server {

std::string HostOf(const std::string& address) {
  const bool has_port = address.empty() || address.back() != ']';
  const size_t colon = has_port ? address.rfind(':') : std::string::npos;
  std::string host = address.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return host;
}

bool IsLoopbackHost(const std::string& host) {
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  return host == "::1" || strcasecmp(host.c_str(), "localhost") == 0;
}

bool IsLoopback(const std::string& address) {
  return address.rfind("unix:", 0) == 0 || IsLoopbackHost(HostOf(address));
}

}  // namespace rollgait::server
