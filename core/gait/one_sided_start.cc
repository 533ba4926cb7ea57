#include "core/gait/one_sided_start.h"

#include <vector>

#include "core/gait/added_constraints.h"
#include "core/gait/half_cycle.h"

namespace rollgait {
namespace {

// For each row of a matrix of `to` the row of the same joint in one of `from`; -1: none.
std::vector<int> Joints(const Model& from, const Model& to) {
  std::vector<int> rows;
  for (const Joint& joint : to.joints()) rows.push_back(from.Find(joint.name));
  return rows;
}

// The same of efforts.
std::vector<int> Efforts(const Model& from, const Model& to) {
  std::vector<int> place(static_cast<size_t>(from.size()), -1), rows;
  for (size_t a = 0; a < from.actuated().size(); ++a) {
    place[static_cast<size_t>(from.actuated()[a])] = static_cast<int>(a);
  }
  for (const int joint : to.actuated()) {
    const int same = from.Find(to.joint(joint).name);
    rows.push_back(same < 0 ? -1 : place[static_cast<size_t>(same)]);
  }
  return rows;
}

MatrixX Rows(const MatrixX& of, const std::vector<int>& rows) {
  MatrixX chosen = MatrixX::Zero(static_cast<int>(rows.size()), of.cols());
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] >= 0) chosen.row(static_cast<int>(i)) = of.row(rows[i]);
  }
  return chosen;
}

}  // namespace

std::optional<GaitSpec> SymmetricStepOf(const GaitSpec& spec) {
  if (!spec.symmetric) return std::nullopt;
  std::optional<GaitSpec> step = HalfCycleOf(*spec.symmetric);
  if (step) step->has_sides_alike = true;
  return step;
}

WarmStart OneSidedStart(const GaitSpec& spec, const GaitSolution& step) {
  const GaitSpec& symmetric = *spec.symmetric;
  WarmStart start;
  start.added = UsualConstraints(spec);
  start.trajectory = BothSteps(symmetric, step).trajectory;
  const std::vector<int> joints = Joints(symmetric.scene.model, spec.scene.model);
  const std::vector<int> efforts = Efforts(symmetric.scene.model, spec.scene.model);
  for (TrajectoryPhase& phase : start.trajectory.phases) {
    for (MatrixX* const of_joints : {&phase.node_positions, &phase.node_velocities, &phase.point_positions,
                                     &phase.point_velocities, &phase.point_accelerations}) {
      *of_joints = Rows(*of_joints, joints);
    }
    phase.point_efforts = Rows(phase.point_efforts, efforts);
  }
  return start;
}

}  // namespace rollgait
