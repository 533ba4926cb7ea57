#include "server/access/token.h"

#include <openssl/crypto.h>

#include <algorithm>

#include "server/base/digest.h"

namespace rollgait::server {
namespace {

constexpr std::string_view kPrefix = "rgt_";
constexpr size_t kIdLetters = 16, kSecretLetters = 52;

bool IsLetter(char letter) { return (letter >= 'a' && letter <= 'z') || (letter >= '2' && letter <= '7'); }

}  // namespace

Token Token::Random() {
  Token token;
  token.id = RandomId();
  while (token.secret.size() < kSecretLetters) token.secret += RandomId();
  token.secret.resize(kSecretLetters);
  return token;
}

std::optional<Token> Token::Parse(std::string_view text) {
  constexpr size_t kSize = kPrefix.size() + kIdLetters + 1 + kSecretLetters;
  if (text.size() != kSize || text.substr(0, kPrefix.size()) != kPrefix) return std::nullopt;
  text.remove_prefix(kPrefix.size());
  const std::string_view id = text.substr(0, kIdLetters), secret = text.substr(kIdLetters + 1);
  if (text[kIdLetters] != '_' || !std::all_of(id.begin(), id.end(), IsLetter) ||
      !std::all_of(secret.begin(), secret.end(), IsLetter)) {
    return std::nullopt;
  }
  return Token{std::string(id), std::string(secret)};
}

std::string Token::Text() const { return std::string(kPrefix) + id + "_" + secret; }

std::string Token::Hash() const { return Sha256Hex(secret); }

bool SameHash(const std::string& a, const std::string& b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace rollgait::server
