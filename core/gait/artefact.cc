#include "core/gait/artefact.h"

namespace rollgait {
namespace {

// Whether surfaces slip between nodes at more than this share of the speed of the motion.
bool SlipsBy(double share, const GaitSpec& spec, const GaitSolution& solution) {
  if (!solution.accuracy) return false;
  double speed = solution.speed;
  if (spec.manoeuvre) {
    // Of the body's surface: it may turn without going anywhere.
    const double rate = solution.trajectory->phases.front().node_velocities.bottomRows(3).colwise().norm().maxCoeff();
    speed = rate * spec.scene.selection.rolling_body->semi_axes.minCoeff();
  }
  // A body at rest slips by rounding.
  const double rounding = spec.manoeuvre ? 1e-6 : 0;
  return solution.accuracy->max_slip > share * speed + rounding;
}

}  // namespace

// Energy that appears from nothing, or vanishes, over the work of the motion. On coarse meshes of motions that finer
// ones have it is up to a seventh.
constexpr double kForeignEnergy = 0.5;

bool IsArtefact(const GaitSpec& spec, const GaitSolution& solution) {
  return SlipsBy(0.2, spec, solution) ||
         (solution.accuracy && solution.accuracy->energy_balance_error_relative > kForeignEnergy);
}

// A coarse mesh may slip at half the speed and still lead to a motion that does not.
bool IsBeyondRefinement(const GaitSpec& spec, const GaitSolution& solution) { return SlipsBy(0.5, spec, solution); }

void RefuseArtefact(const GaitSpec& spec, GaitSolution* solution) {
  solution->termination = Termination::kNumericalDifficulty;
  solution->message =
      "Only motions that exist on the mesh were found: the feet slip between its nodes. Use more intervals, more "
      "refinements or a less demanding request.";
  solution->unmet_constraints.insert(
      solution->unmet_constraints.begin(),
      {"rolling between nodes", 0, 0, solution->accuracy->max_slip - spec.bounds[Criterion::kSlip], "m/s"});
}

}  // namespace rollgait
