#ifndef ROLLGAIT_SERVER_BASE_DIGEST_H_
#define ROLLGAIT_SERVER_BASE_DIGEST_H_

#include <cstddef>
#include <string>
#include <string_view>

#include "server/base/outcome.h"

namespace rollgait::server {

// SHA-256 as 64 lower-case hexadecimal digits.
std::string Sha256Hex(std::string_view bytes);

// The same of a file. kUnavailable if it cannot be read.
Outcome<std::string> Sha256HexOfFile(const std::string& path);

// Eighty random bits as 16 characters of a-z and 2-7: names of solves, owners of leases.
std::string RandomId();

// So many random bytes (at most 256) as lower-case hexadecimal digits.
std::string RandomHex(size_t bytes);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_DIGEST_H_
