#ifndef ROLLGAIT_SERVER_BASE_OUTCOME_H_
#define ROLLGAIT_SERVER_BASE_OUTCOME_H_

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/check.h"
#include "core/base/result.h"

namespace rollgait::server {

// Why a call on the store or on the service did not do what was asked. Each code has one RPC status
// (server/rpc/status).
enum class ErrorCode {
  kInvalidArgument,     // the request; `violations` says what, field by field
  kNotFound,            // no such solve, model
  kAlreadyExists,       // request_id is in use with another spec
  kFailedPrecondition,  // the solve is in another state than the call needs
  kOutOfRange,          // sequence number beyond the newest event
  kUnauthenticated,     // no token or certificate, or one that is not valid (any more)
  kPermissionDenied,    // the caller is known and may not do this
  kResourceExhausted,   // the queue is full, or a quota; `retry_after` says when to try again
  kDeadlineExceeded,    // the run took longer than it was given
  kLeaseLost,           // the solve belongs to another epoch now: stop working on it, write nothing more
  kUnavailable,         // busy, disk full, stopping: the same call may succeed later
  kInternal,            // a defect or a damaged file
};

// A limit of one tenant that a call has reached.
struct QuotaViolation {
  std::string subject;      // "tenant:acme"
  std::string description;  // "20 solves are queued, the limit is 20"
};

struct Error {
  ErrorCode code;
  std::string message;  // one sentence with the value, the limit and what to do next
  Violations violations = {};
  std::optional<std::chrono::milliseconds> retry_after = std::nullopt;
  std::optional<QuotaViolation> quota = std::nullopt;  // with kResourceExhausted
};

// The value of a call that has none.
struct Done {};

// A value or the reason why there is none.
template <typename T>
class [[nodiscard]] Outcome {
 public:
  Outcome(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Outcome(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  const T& value() const& {
    ROLLGAIT_CHECK(ok());
    return std::get<0>(state_);
  }
  T& value() & {
    ROLLGAIT_CHECK(ok());
    return std::get<0>(state_);
  }
  T&& value() && {
    ROLLGAIT_CHECK(ok());
    return std::get<0>(std::move(state_));
  }
  const Error& error() const {
    ROLLGAIT_CHECK(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_OUTCOME_H_
