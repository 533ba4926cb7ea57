// What a person needs to know of an X.509 certificate.
#ifndef ROLLGAIT_CLIENT_CERTIFICATE_H_
#define ROLLGAIT_CLIENT_CERTIFICATE_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rollgait::client {

struct Certificate {
  std::string subject;                        // its common name; may be empty
  std::vector<std::string> names;             // DNS names and IP addresses that it is for
  int64_t not_before_s = 0, not_after_s = 0;  // since 1970, UTC
};

// The first certificate of a PEM text; nullopt: there is none that can be read.
std::optional<Certificate> ReadCertificate(const std::string& pem);

// Whether the first certificate of a PEM text is for a host name or IP address, wildcards included.
bool IsCertificateFor(const std::string& pem, const std::string& host);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_CERTIFICATE_H_
