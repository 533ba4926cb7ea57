#include "server/store/page_token.h"

#include <array>
#include <charconv>
#include <cstdio>

#include "server/base/digest.h"

namespace rollgait::server {
namespace {

// The hidden number in so many hexadecimal digits, then those that tie it to the filter.
constexpr size_t kNumberDigits = 16, kCheckDigits = 8;
constexpr int kRounds = 4;

uint32_t Mix(const std::string& secret, const std::string& label, uint32_t half) {
  const std::string digest = Sha256Hex(secret + " " + label + " " + std::to_string(half));
  uint32_t value = 0;
  std::from_chars(digest.data(), digest.data() + 8, value, 16);
  return value;
}

// A permutation of 64 bits that only the secret undoes: a Feistel network (Luby and Rackoff 1988), four rounds.
uint64_t Hide(uint64_t number, const std::string& secret) {
  auto left = static_cast<uint32_t>(number >> 32), right = static_cast<uint32_t>(number);
  for (int round = 0; round < kRounds; ++round) {
    const uint32_t next = left ^ Mix(secret, "round " + std::to_string(round), right);
    left = right;
    right = next;
  }
  return uint64_t{left} << 32 | right;
}

uint64_t Show(uint64_t hidden, const std::string& secret) {
  auto left = static_cast<uint32_t>(hidden >> 32), right = static_cast<uint32_t>(hidden);
  for (int round = kRounds - 1; round >= 0; --round) {
    const uint32_t before = right ^ Mix(secret, "round " + std::to_string(round), left);
    right = left;
    left = before;
  }
  return uint64_t{left} << 32 | right;
}

std::string Check(const std::string& number, const ListQuery& query, const std::string& secret) {
  const std::string state = query.state.has_value() ? std::to_string(static_cast<int>(*query.state)) : "all";
  const std::string tenant = query.tenant.has_value() ? " of " + *query.tenant : "";
  const std::string text = FilterText(query.filter);
  const std::string filter = text.empty() ? "" : " filter\n" + text;  // no tenant's name has a line end
  return Sha256Hex(secret + " rollgait page " + number + " " + state + tenant + filter).substr(0, kCheckDigits);
}

}  // namespace

std::string MakePageToken(int64_t before_number, const ListQuery& query, const std::string& secret) {
  std::array<char, kNumberDigits + 1> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(Hide(static_cast<uint64_t>(before_number), secret)));
  const std::string number(digits.data());
  return number + Check(number, query, secret);
}

std::optional<int64_t> ParsePageToken(const ListQuery& query, const std::string& secret) {
  const std::string& token = query.page_token;
  if (token.size() != kNumberDigits + kCheckDigits) return std::nullopt;
  const std::string number = token.substr(0, kNumberDigits);
  if (token.substr(kNumberDigits) != Check(number, query, secret)) return std::nullopt;
  uint64_t hidden = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), hidden, 16);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  const auto value = static_cast<int64_t>(Show(hidden, secret));
  if (value < 0) return std::nullopt;
  return value;
}

}  // namespace rollgait::server
