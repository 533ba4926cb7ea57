#ifndef ROLLGAIT_SERVER_BASE_DIGEST_H_
#define ROLLGAIT_SERVER_BASE_DIGEST_H_

#include <string>
#include <string_view>

#include "server/base/outcome.h"

namespace rollgait::server {

// SHA-256 as 64 lower-case hexadecimal digits.
std::string Sha256Hex(std::string_view bytes);

// The same of a file. kUnavailable if it cannot be read.
Outcome<std::string> Sha256HexOfFile(const std::string& path);

// What names a build of a program in results and in solve keys: project version and the first 12 digits of the digest
// of its executable, "0.1.0+3f2a90c41b7e". Two programs with the same build answer a request alike.
Outcome<std::string> BuildOfExecutable(const std::string& path);

// Eighty random bits as 16 characters of a-z and 2-7: names of solves, owners of leases.
std::string RandomId();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_DIGEST_H_
