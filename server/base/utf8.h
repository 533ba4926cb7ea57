#ifndef ROLLGAIT_SERVER_BASE_UTF8_H_
#define ROLLGAIT_SERVER_BASE_UTF8_H_

#include <cstddef>
#include <string_view>

namespace rollgait::server {

// Bytes of the well-formed UTF-8 sequence that begins at `text[at]`; 0 if none does (overlong forms, surrogates,
// numbers beyond U+10FFFF and cut sequences are none). `at` is below the size.
size_t Utf8SequenceLength(std::string_view text, size_t at);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_UTF8_H_
