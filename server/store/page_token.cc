#include "server/store/page_token.h"

#include <algorithm>
#include <charconv>

#include "server/base/digest.h"

namespace rollgait::server {
namespace {

// Hexadecimal number, then eight digits that tie it to the filter.
constexpr size_t kCheckDigits = 8;

std::string Check(const std::string& number, const ListQuery& query) {
  const std::string state = query.state.has_value() ? std::to_string(static_cast<int>(*query.state)) : "all";
  const std::string tenant = query.tenant.has_value() ? " of " + *query.tenant : "";
  return Sha256Hex("rollgait page " + number + " " + state + tenant).substr(0, kCheckDigits);
}

}  // namespace

std::string MakePageToken(int64_t before_number, const ListQuery& query) {
  char buffer[17];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), before_number, 16).ptr;
  const std::string number(buffer, end);
  return number + Check(number, query);
}

std::optional<int64_t> ParsePageToken(const ListQuery& query) {
  const std::string& token = query.page_token;
  if (token.size() <= kCheckDigits || token.size() > kCheckDigits + 16) return std::nullopt;
  const std::string number = token.substr(0, token.size() - kCheckDigits);
  if (token.substr(number.size()) != Check(number, query)) return std::nullopt;
  int64_t value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value, 16);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  return value;
}

}  // namespace rollgait::server
