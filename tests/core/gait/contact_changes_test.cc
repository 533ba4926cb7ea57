// States of docs/explanation/contact_changes.md: how far the Delassus matrix of the walkers couples normal and
// tangential directions, and that the optimum of the preset human does not depend on mesh and scheme where forces
// vanish with their contacts.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numbers>
#include <vector>

#include "core/contact/rolling_kinematics.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

GaitRequest Human(const char* model, Scheme scheme, int intervals, double slope_deg) {
  GaitRequest request;
  request.body.model = model;
  request.preset = Preset::kHuman;
  request.slope = slope_deg * std::numbers::pi / 180;
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.scheme = scheme;
  request.discretization.single_support_intervals = intervals;
  return request;
}

// Without the condition: 0.186, 0.189 and 0.195 (docs/explanation/contact_changes.md), 5 % apart.
TEST(ContactChanges, TheOptimumOfThePresetHumanIsThatOfEveryMeshAndScheme) {
  std::vector<double> objectives;
  for (const auto& [scheme, intervals] : {std::pair(Scheme::kRadau2, 64), std::pair(Scheme::kRadau2, 128),
                                          std::pair(Scheme::kRadau3, 64), std::pair(Scheme::kHermiteSimpson, 128)}) {
    const GaitSolution solution =
        OptimizingGaitSolver().Solve(CheckRequest(Human("planar", scheme, intervals, -10)).value(), {});
    ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
    objectives.push_back(solution.objective);
  }
  const auto [least, most] = std::minmax_element(objectives.begin(), objectives.end());
  EXPECT_LT(*most, 1.01 * *least);
}

// Heel and toe are given up, and taken up, without force; what the heel had along x the forefoot bears.
TEST(ContactChanges, ForcesAreZeroWhereContactsChange) {
  const GaitSpec spec = CheckRequest(Human("planar", Scheme::kRadau2, 32, 0)).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, {});
  ASSERT_TRUE(solution.trajectory);
  const double weight = spec.scene.model.total_mass() * spec.gravity.norm();
  const auto& phases = solution.trajectory->phases;
  int given = 0;
  for (size_t p = 0; p < phases.size(); ++p) {
    const bool wraps = p + 1 == phases.size();
    for (size_t c = 0; c < phases[p].contacts.size(); ++c) {
      const int contact = phases[p].contacts[c], seen = wraps ? spec.scene.contacts[contact].mirror_contact : contact;
      const std::vector<int>& next = phases[wraps ? 0 : p + 1].contacts;
      if (std::find(next.begin(), next.end(), seen) != next.end()) continue;
      const Eigen::Index last = phases[p].point_forces.cols() - 1;
      EXPECT_LT(phases[p].point_forces.col(last).segment<3>(3 * static_cast<int>(c)).norm(), 1e-6 * weight);
      ++given;
    }
  }
  EXPECT_EQ(given, 2);
}

// S_nn > 0.45 |S_nt| for one foot that is given up while the other stays, in the postures of a walk on -20 to 20
// degrees: under load it could be given up only with more than 0.45 of its normal force along the ground, in one of the
// two directions.
TEST(ContactChanges, AFootIsNotGivenUpUnderLoadWithLessFrictionThanThat) {
  for (const double slope : {-20.0, 0.0, 20.0}) {
    const GaitSpec spec = CheckRequest(Human("planar", Scheme::kRadau2, 16, slope)).value();
    const GaitSolution solution = OptimizingGaitSolver().Solve(spec, {});
    ASSERT_TRUE(solution.trajectory);
    const BodyDynamics dynamics(spec.scene.model);
    const int n = spec.scene.model.size();
    int checked = 0;
    for (const TrajectoryPhase& phase : solution.trajectory->phases) {
      if (phase.contacts.size() < 2) continue;
      const VectorX q = phase.node_positions.col(phase.node_positions.cols() - 1);
      // Rows of a contact along x and z: velocities of its material point under unit velocities of the joints.
      const auto rows = [&](int contact) {
        MatrixX jacobian(2, n);
        BodyDynamics::State state;
        for (int j = 0; j < n; ++j) {
          dynamics.ComputeState(q, VectorX::Unit(n, j), &state);
          const RollingContact rolling = ComputeRollingContact(spec.scene.contacts[contact], state);
          jacobian.col(j) << rolling.slip[0], rolling.slip[2];
        }
        return jacobian;
      };
      BodyDynamics::State state;
      dynamics.ComputeState(q, VectorX::Zero(n), &state);
      BodyDynamics::Workspace workspace;
      MatrixX mass;
      dynamics.MassMatrix(state, &workspace, &mass);
      const MatrixX inverse = mass.inverse();
      for (const int released : phase.contacts) {
        for (const int stays : phase.contacts) {
          if (spec.scene.contacts[stays].joint == spec.scene.contacts[released].joint) continue;
          const MatrixX held = rows(stays), free = rows(released);
          const MatrixX coupling = inverse * held.transpose();
          const MatrixX projected = inverse - coupling * (held * coupling).inverse() * coupling.transpose();
          const MatrixX delassus = free * projected * free.transpose();
          EXPECT_GT(delassus(1, 1), 0.45 * std::abs(delassus(1, 0)))
              << spec.scene.contacts[released].name << " at " << slope;
          ++checked;
        }
      }
    }
    EXPECT_GT(checked, 0);
  }
}

}  // namespace
}  // namespace rollgait
