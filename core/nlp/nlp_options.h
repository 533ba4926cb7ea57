#ifndef ROLLGAIT_CORE_NLP_NLP_OPTIONS_H_
#define ROLLGAIT_CORE_NLP_NLP_OPTIONS_H_

#include "core/base/types.h"

namespace rollgait {

// Where a solve starts. Empty multipliers: a cold start.
struct NlpStart {
  VectorX x;
  VectorX constraint_multipliers;
  VectorX lower_bound_multipliers;
  VectorX upper_bound_multipliers;
};

struct NlpOptions {
  double tolerance = 1e-6;
  int max_iterations = 1000;
  double max_wall_time_s = 600;
  double initial_barrier = 0.1;  // μ₀; small for a warm start
  int mesh = 0;                  // passed on with every iteration
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_NLP_OPTIONS_H_
