#ifndef ROLLGAIT_TESTS_CORE_GAIT_MOTION_RESIDUALS_H_
#define ROLLGAIT_TESTS_CORE_GAIT_MOTION_RESIDUALS_H_

#include <string>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/meshes.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

// How far a motion is from meeting the program of a spec, and its cost.
struct Residuals {
  double rows = 0, bounds = 0, objective = 0;
  std::string worst_row;
};

inline Residuals ResidualsAt(const GaitSpec& spec, const WarmStart& motion) {
  const auto problem = BuildProblem(spec);
  CollocationNlp nlp(*problem, spec.scheme, MeshOf(motion.trajectory), motion.added);
  const VectorX x = nlp.MakeStart(GuessFromTrajectory(motion.trajectory));
  VectorX g(nlp.constraints());
  Residuals residuals;
  if (!nlp.Constraints(x.data(), g.data()) || !nlp.Objective(x.data(), &residuals.objective)) {
    residuals.rows = kInfinity;
    return residuals;
  }
  residuals.objective /= nlp.objective_scale();
  int row = 0;
  residuals.rows = (nlp.constraint_lower() - g).cwiseMax(g - nlp.constraint_upper()).maxCoeff(&row);
  residuals.worst_row = nlp.Describe(x.data(), row).name;
  residuals.bounds = (nlp.lower_bounds() - x).cwiseMax(x - nlp.upper_bounds()).maxCoeff();
  return residuals;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_GAIT_MOTION_RESIDUALS_H_
