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
