#include "server/base/digest.h"

#include <openssl/evp.h>
#include <sys/random.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <memory>

namespace rollgait::server {
namespace {

std::string HexOf(const unsigned char* bytes, size_t count) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    ROLLGAIT_CHECK(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void Add(const char* data, size_t size) { ROLLGAIT_CHECK(EVP_DigestUpdate(context_.get(), data, size) == 1); }
  std::string Hex() {
    std::array<unsigned char, 32> digest;
    ROLLGAIT_CHECK(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
    return HexOf(digest.data(), digest.size());
  }

 private:
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  Sha256 sha;
  sha.Add(bytes.data(), bytes.size());
  return sha.Hex();
}

Outcome<std::string> Sha256HexOfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 sha;
  std::array<char, 65536> buffer;
  while (file) {
    file.read(buffer.data(), buffer.size());
    sha.Add(buffer.data(), static_cast<size_t>(file.gcount()));
  }
  if (!file.eof()) return Error{ErrorCode::kUnavailable, "cannot read " + path};
  return sha.Hex();
}

std::string RandomId() {
  std::array<uint8_t, 16> bytes;
  ROLLGAIT_CHECK(getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  constexpr char kLetters[] = "abcdefghijklmnopqrstuvwxyz234567";
  std::string id;
  for (const uint8_t byte : bytes) id += kLetters[byte & 31];
  return id;
}

std::string RandomHex(size_t bytes) {
  std::array<unsigned char, 256> random;
  ROLLGAIT_CHECK(bytes <= random.size());
  ROLLGAIT_CHECK(getrandom(random.data(), bytes, 0) == static_cast<ssize_t>(bytes));
  return HexOf(random.data(), bytes);
}

}  // namespace rollgait::server
