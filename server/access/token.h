#ifndef ROLLGAIT_SERVER_ACCESS_TOKEN_H_
#define ROLLGAIT_SERVER_ACCESS_TOKEN_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rollgait::server {

// A bearer token: "rgt_" id "_" secret. The id names it in lists and audit rows. The secret is 260 random bits, so that
// its SHA-256 is what may be stored: nobody tries 2^260 inputs, however fast the hash; slow ones protect what people
// think up.
struct Token {
  std::string id, secret;

  static Token Random();
  // nullopt: not of this form.
  static std::optional<Token> Parse(std::string_view text);
  std::string Text() const;
  // 64 hexadecimal digits.
  std::string Hash() const;
};

// Whether two hashes are equal, in a time that does not depend on where they differ.
bool SameHash(const std::string& a, const std::string& b);

// A token as it is stored. Times in µs since 1970; 0: never.
struct TokenRecord {
  std::string id, hash, tenant, note;
  unsigned scopes = 0;
  int64_t create_time_us = 0, expire_time_us = 0, revoke_time_us = 0;

  bool valid_at(int64_t now_us) const {
    return revoke_time_us == 0 && (expire_time_us == 0 || now_us < expire_time_us);
  }
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_TOKEN_H_
