#ifndef ROLLGAIT_SERVER_BASE_LISTEN_ADDRESS_H_
#define ROLLGAIT_SERVER_BASE_LISTEN_ADDRESS_H_

#include <string>

namespace rollgait::server {

// HOST of "HOST:PORT" or of HOST alone, without the brackets of an IPv6 address.
std::string HostOf(const std::string& address);

// True if every address that a host stands for is a loopback address: 127.0.0.0/8, ::1, localhost in any case of
// letters. By name alone: no name is looked up.
bool IsLoopbackHost(const std::string& host);

// The same of "HOST:PORT"; and of "unix:PATH", which no other machine reaches either.
bool IsLoopback(const std::string& address);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LISTEN_ADDRESS_H_
