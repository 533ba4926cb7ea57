#ifndef ROLLGAIT_SERVER_BASE_TRACE_CONTEXT_H_
#define ROLLGAIT_SERVER_BASE_TRACE_CONTEXT_H_

#include <string>
#include <string_view>

namespace rollgait::server {

// W3C Trace Context, version 00: "00-<trace id, 32 hex digits>-<parent id, 16>-<flags, 2>", lower case, neither id
// zero.
bool IsTraceparent(std::string_view text);

// A traceparent of our own: in the trace of `received` with its flags if that is one, else in a new trace; its parent
// id is new.
std::string ContinueTrace(std::string_view received);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_TRACE_CONTEXT_H_
