// Short digests that name requests.
#ifndef ROLLGAIT_CLIENT_SWEEP_REQUEST_DIGEST_H_
#define ROLLGAIT_CLIENT_SWEEP_REQUEST_DIGEST_H_

#include <string>

#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::client {

// The first 12 bytes of the SHA-256 of `bytes`, 24 hexadecimal digits. Throws Failure(kInternal) if libcrypto refuses.
std::string Digest(const std::string& bytes);

// Equal for equal requests: the entries of maps are in the order of their keys.
std::string BytesOf(const v1::SolveSpec& spec);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_REQUEST_DIGEST_H_
