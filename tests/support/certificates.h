#ifndef ROLLGAIT_TESTS_SUPPORT_CERTIFICATES_H_
#define ROLLGAIT_TESTS_SUPPORT_CERTIFICATES_H_

#include <string>

namespace rollgait {

// A certificate and its key, PEM.
struct Identity {
  std::string cert, key;
};

// Signs itself, for ten years.
Identity MakeAuthority(const std::string& name);
// For `name`, localhost and 127.0.0.1, valid from `from_s` to `until_s` seconds from now; signed by the authority.
Identity MakeCertificate(const Identity& authority, const std::string& name, long from_s = -86'400,
                         long until_s = 86'400);

// Writes a file; a file of that name is replaced at once.
void WriteFileAtOnce(const std::string& path, const std::string& text);

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_CERTIFICATES_H_
