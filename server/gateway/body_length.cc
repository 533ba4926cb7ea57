#include "server/gateway/body_length.h"

#include <charconv>

namespace rollgait::server {

BodyLength BodyLengthOf(const HttpRequest& head, uint64_t limit) {
  const bool is_encoded = head.headers.count("transfer-encoding") > 0;
  const bool has_length = head.headers.count("content-length") > 0;
  // Section 6.1: whoever passes it on may read another length.
  if (is_encoded && has_length) return {0, 400, "Content-Length and Transfer-Encoding are both given"};
  if (is_encoded) return {0, 411, "a body must come with Content-Length, not with Transfer-Encoding"};
  if (!has_length) return {};
  const std::string length = head.Header("content-length");
  const char* const end = length.data() + length.size();
  uint64_t bytes = 0;
  const auto parsed = std::from_chars(length.data(), end, bytes);
  const bool is_out_of_range = parsed.ec == std::errc::result_out_of_range;
  if (parsed.ptr != end || (parsed.ec != std::errc() && !is_out_of_range))
    return {0, 400, "Content-Length is no number"};
  if (is_out_of_range || bytes > limit) {
    return {0, 413, "the body has " + length + " bytes, the limit is " + std::to_string(limit)};
  }
  return {bytes, 0, ""};
}

}  // namespace rollgait::server
