#include "server/store/page_token.h"

#include <algorithm>
#include <charconv>

#include "server/base/digest.h"

namespace rollgait::server {
namespace {

// Hexadecimal number, then eight digits that tie it to the filter.
constexpr size_t kCheckDigits = 8;

std::string Check(const std::string& number, const std::optional<SolveState>& state) {
  const std::string filter = state.has_value() ? std::to_string(static_cast<int>(*state)) : "all";
  return Sha256Hex("rollgait page " + number + " " + filter).substr(0, kCheckDigits);
}

}  // namespace

std::string MakePageToken(int64_t before_number, const std::optional<SolveState>& state) {
  char buffer[17];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), before_number, 16).ptr;
  const std::string number(buffer, end);
  return number + Check(number, state);
}

std::optional<int64_t> ParsePageToken(const std::string& token, const std::optional<SolveState>& state) {
  if (token.size() <= kCheckDigits || token.size() > kCheckDigits + 16) return std::nullopt;
  const std::string number = token.substr(0, token.size() - kCheckDigits);
  if (token.substr(number.size()) != Check(number, state)) return std::nullopt;
  int64_t value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value, 16);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  return value;
}

}  // namespace rollgait::server
