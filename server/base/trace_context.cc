#include "server/base/trace_context.h"

#include <cstddef>

#include "server/base/digest.h"

namespace rollgait::server {
namespace {

constexpr size_t kTraceAt = 3, kTraceDigits = 32, kParentAt = 36, kParentDigits = 16, kFlagsAt = 53, kLength = 55;

bool IsHex(std::string_view text) { return text.find_first_not_of("0123456789abcdef") == std::string_view::npos; }
bool IsId(std::string_view text) { return IsHex(text) && text.find_first_not_of('0') != std::string_view::npos; }

}  // namespace

bool IsTraceparent(std::string_view text) {
  return text.size() == kLength && text.substr(0, kTraceAt) == "00-" && text[kParentAt - 1] == '-' &&
         text[kFlagsAt - 1] == '-' && IsId(text.substr(kTraceAt, kTraceDigits)) &&
         IsId(text.substr(kParentAt, kParentDigits)) && IsHex(text.substr(kFlagsAt));
}

std::string ContinueTrace(std::string_view received) {
  const bool known = IsTraceparent(received);
  const std::string trace = known ? std::string(received.substr(kTraceAt, kTraceDigits)) : RandomHex(kTraceDigits / 2);
  const std::string flags = known ? std::string(received.substr(kFlagsAt)) : "00";
  return "00-" + trace + "-" + RandomHex(kParentDigits / 2) + "-" + flags;
}

}  // namespace rollgait::server
