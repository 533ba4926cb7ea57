#ifndef ROLLGAIT_CORE_GAIT_REQUEST_CHECK_H_
#define ROLLGAIT_CORE_GAIT_REQUEST_CHECK_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/field_path.h"
#include "core/base/result.h"
#include "core/gait/gait_spec.h"

namespace rollgait {

// Limits that keep a request small. Documented in rollgait.v1.SolveSpec.
inline constexpr int kMaxTotalIntervals = 4000;
inline constexpr int kMaxPhases = 40;
inline constexpr int kMaxCostTerms = 32;
inline constexpr int kMaxTrackedPositions = 10000;
inline constexpr double kMaxWeight = 1e6;
inline constexpr double kMaxPosition = 100;   // rad or m
inline constexpr double kMaxVelocity = 1000;  // rad/s or m/s
inline constexpr double kMaxEffort = 1e6;     // N m or N

// Admissible range of a number. With `above_min` the lower end itself is refused.
struct NumberLimits {
  double min;
  double max;
  const char* unit = "";
  bool above_min = false;
};

// Collects what is wrong with a request, in the order of the calls. At most kMaxViolations are kept, so that an answer
// fits into the trailers of a call; the last one then tells how many more there are.
class RequestCheck {
 public:
  static constexpr size_t kMaxViolations = 20;

  void Add(std::string field, std::string message);

  // Returns the value, or `fallback` if it is unset; adds a violation if it is not finite or outside the limits.
  double Number(const std::string& field, std::optional<double> value, double fallback, const NumberLimits& limits);
  int Integer(const std::string& field, std::optional<int> value, int fallback, int min, int max);
  // Adds a violation unless both ends are finite, within the limits and min < max (min <= max if `may_be_equal`).
  void Range(const std::string& field, const GaitRequest::Range& range, const NumberLimits& limits, bool may_be_equal);
  // Index of the joint, -1 (and a violation) if there is none or it is not actuated although it must be.
  int Joint(const std::string& field, const std::string& name, const Scene& scene, bool must_be_actuated);

  bool ok() const { return violations_.empty(); }
  // What was found; contract: !ok().
  Violations Take();

 private:
  Violations violations_;
  size_t left_out_ = 0;
};

// A number as it is written in messages.
std::string FormatNumber(double value);
// The names, separated by commas, cut after the first twelve.
std::string ListNames(const std::vector<std::string>& names);

// The parts of CheckRequest. `scene` is null if the model could not be built; what depends on it is then not checked.
std::vector<GaitSpec::Phase> CheckPhases(const GaitRequest& request, const Scene* scene, const Similarity& similarity,
                                         RequestCheck& check);
std::vector<GaitSpec::CostTerm> CheckCosts(const GaitRequest& request, const Scene* scene, const Similarity& similarity,
                                           RequestCheck& check);
// The joints of the model with the limits of the request, and those of its preset where it has none; empty without a
// scene.
std::vector<Joint> CheckLimits(const GaitRequest& request, const Scene* scene, const Similarity& similarity,
                               RequestCheck& check);

struct CheckedMotion {
  std::optional<double> speed, step_length, step_duration;
  GaitRequest::Range speed_range, step_length_range, step_duration_range;
};
CheckedMotion CheckMotion(const GaitRequest& request, const Scene* scene, double gravity, const Similarity& similarity,
                          const std::vector<GaitSpec::Phase>& phases, RequestCheck& check);

// For a request with a manoeuvre, in place of CheckPhases and CheckMotion.
struct CheckedManoeuvre {
  Manoeuvre manoeuvre;
  std::vector<GaitSpec::Phase> phases;
};
CheckedManoeuvre CheckManoeuvre(const GaitRequest& request, const Scene* scene, RequestCheck& check);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_REQUEST_CHECK_H_
