#include "client/sweep/request_digest.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <openssl/evp.h>

#include <array>

#include "client/failure.h"

namespace rollgait::client {

std::string Digest(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw Failure(ExitCode::kInternal, "libcrypto computes no SHA-256");
  }
  constexpr unsigned kBytes = 12;
  std::string text;
  for (unsigned i = 0; i < kBytes; ++i) {
    for (const int digit : {digest[i] >> 4, digest[i] & 15}) text += "0123456789abcdef"[digit];
  }
  return text;
}

std::string BytesOf(const v1::SolveSpec& spec) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    if (!spec.SerializeToCodedStream(&coded)) throw Failure(ExitCode::kInternal, "a request cannot be serialized");
  }
  return bytes;
}

}  // namespace rollgait::client
