// Bytes as text.
#ifndef ROLLGAIT_CLIENT_BASE64_H_
#define ROLLGAIT_CLIENT_BASE64_H_

#include <string>

namespace rollgait::client {

// RFC 4648, with padding.
std::string Base64(const std::string& bytes);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_BASE64_H_
