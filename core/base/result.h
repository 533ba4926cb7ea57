#ifndef ROLLGAIT_CORE_BASE_RESULT_H_
#define ROLLGAIT_CORE_BASE_RESULT_H_

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/check.h"

namespace rollgait {

// One thing a user got wrong: the path of the field as it is written in the proto ("motion.speed_m_s",
// "phases.phases[1].contacts[0]"), and a sentence with the value and the limit.
struct Violation {
  std::string field;
  std::string message;
};

using Violations = std::vector<Violation>;

// A value, or everything that is wrong with the input it was to be made from (never empty).
template <typename T>
class Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Violations violations) : state_(std::move(violations)) {
    ROLLGAIT_CHECK(!std::get<Violations>(state_).empty());
  }

  bool ok() const { return std::holds_alternative<T>(state_); }
  const T& value() const& {
    ROLLGAIT_CHECK(ok());
    return std::get<T>(state_);
  }
  T&& value() && {
    ROLLGAIT_CHECK(ok());
    return std::get<T>(std::move(state_));
  }
  const Violations& violations() const {
    ROLLGAIT_CHECK(!ok());
    return std::get<Violations>(state_);
  }

 private:
  std::variant<T, Violations> state_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_BASE_RESULT_H_
