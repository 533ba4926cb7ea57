#include "client/tradeoff/true_errors.h"

#include <algorithm>
#include <cmath>

#include "client/failure.h"
#include "client/joint_kinds.h"
#include "client/report/motion.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kInstants = 200;  // a phase

double TimeOf(const Motion::PhaseSpan& span, int instant) {
  return span.start_s + (instant + 0.5) / kInstants * (span.end_s - span.start_s);
}

}  // namespace

TrueErrors ErrorsAgainst(const v1::SolveResult& reference, const v1::SolveResult& result) {
  const v1::Model& model = reference.model();
  const Motion one(reference.trajectory(), model), other(result.trajectory(), model);
  if (one.phases().size() != other.phases().size()) {
    throw Failure(ExitCode::kUsage, "two solutions of one request have " + std::to_string(one.phases().size()) +
                                        " and " + std::to_string(other.phases().size()) + " phases");
  }
  TrueErrors errors;
  errors.objective = std::abs(result.objective() / reference.objective() - 1);
  for (size_t p = 0; p < one.phases().size(); ++p) {
    for (int i = 0; i < kInstants; ++i) {
      const Instant a = one.At(TimeOf(one.phases()[p], i)), b = other.At(TimeOf(other.phases()[p], i));
      for (int j = 0; j < model.joints_size(); ++j) {
        if (!Turns(model.joints(j))) continue;
        errors.angle_deg = std::max(errors.angle_deg, std::abs(a.position[j] - b.position[j]) * 180 / kPi);
        errors.torque_n_m = std::max(errors.torque_n_m, std::abs(a.effort[j] - b.effort[j]));
      }
    }
  }
  return errors;
}

}  // namespace rollgait::client
