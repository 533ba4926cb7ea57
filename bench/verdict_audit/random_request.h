// Requests drawn by a seeded generator.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_RANDOM_REQUEST_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_RANDOM_REQUEST_H_

#include <cstdint>
#include <optional>
#include <string>

#include "core/gait/gait_spec.h"

namespace rollgait::audit {

struct DrawOptions {
  uint64_t seed = 1;
  std::optional<GaitRequest::AccuracyLevel> level;  // unset: drafts, standard and fine ones
  double time_limit = 60;                           // s, of each
  double planar = 0.4;                              // share of the planar model, from 0 to 1; the rest is human29
  double steepest = 25;                             // degrees, up and down
  bool max_error = false;  // each asks for one: of the objective 1 % to 0.01 %, of angles 2° to 0.1°, of torques 20 to
                           // 1 N m, as evenly over the logarithm
};

struct DrawnRequest {
  GaitRequest request;
  std::string group;    // model and preset
  std::string command;  // what `rollgait` is told to do the same
};

// Request `number` of a seed; it does not depend on those before it. Every machine and standard library draws the same.
DrawnRequest Draw(const DrawOptions& options, int number);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_RANDOM_REQUEST_H_
