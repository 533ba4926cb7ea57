// Faults of known size planted in a gait: the second judge finds each, as large as it is, and so does the first.
#include "bench/verdict_audit/second_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/verdict_audit/interval_motion.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/validation/report.h"

namespace rollgait::audit {
namespace {

struct Gait {
  GaitSpec spec;
  Trajectory trajectory;
};

Gait Solve(GaitRequest::TouchDown touch_down, const std::map<std::string, double>& exponents = {}) {
  GaitRequest request;
  request.body.changes.foot_exponents = exponents;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization = {Scheme::kRadau3, 24, 12};
  request.ground_contact.touch_down = touch_down;
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  return {spec, solution.trajectory.value()};
}

const Gait& Smooth() {
  static const Gait gait = Solve(GaitRequest::TouchDown::kSmooth);
  return gait;
}
const Gait& Plastic() {
  static const Gait gait = Solve(GaitRequest::TouchDown::kPlastic);
  return gait;
}

const Gait& OnSuperellipsoids() {
  static const Gait gait = Solve(GaitRequest::TouchDown::kSmooth, {{"foot", 0.8}});
  return gait;
}

CriterionValues Second(const Gait& gait) { return MeasureTrajectory(gait.spec, gait.trajectory); }

CriterionValues First(const Gait& gait) {
  ValidationOptions options;
  options.gravity = gait.spec.gravity;
  options.friction_coefficient = gait.spec.friction_coefficient;
  options.min_normal_force =
      gait.spec.min_normal_force_bw * gait.spec.scene.model.total_mass() * gait.spec.gravity.norm();
  const AccuracyReport report = Validate(gait.spec.scene, gait.trajectory, options);
  CriterionValues values;
  for (const CriterionTraits& traits : Criteria()) {
    values[traits.criterion] = report.findings[static_cast<size_t>(traits.criterion)].value;
  }
  return values;
}

// Both judges measure `size` up to the share of 1 % and what the gait had before.
void ExpectFault(const Gait& gait, const Gait& sound, Criterion criterion, double size) {
  const double before = Second(sound)[criterion];
  ASSERT_LT(before, 0.2 * size) << TraitsOf(criterion).field << ": the fault would not be seen";
  EXPECT_NEAR(Second(gait)[criterion], size, 0.01 * size + before) << TraitsOf(criterion).field;
  EXPECT_NEAR(First(gait)[criterion], size, 0.02 * size + before) << TraitsOf(criterion).field;
}

// The same gait with limits of one joint changed.
Gait WithJoint(const Gait& gait, int joint, const std::function<void(Joint&)>& change) {
  Gait changed = gait;
  std::vector<Joint> joints = gait.spec.scene.model.joints();
  change(joints[static_cast<size_t>(joint)]);
  changed.spec.scene.model = Model::Create(std::move(joints)).value();
  return changed;
}

int JointOf(const Gait& gait, const char* name) {
  const int joint = gait.spec.scene.model.Find(name);
  EXPECT_GE(joint, 0);
  return joint;
}

// What is looked for at every instant is at least what is found at 41 an interval; what is one number for an interval
// or for the motion is the same, but for the errors of the two integrators and, of the energy, of the work, whose
// positive and negative parts meet between instants.
TEST(SecondJudge, FindsWhatTheFirstFindsInASoundGait) {
  using enum Criterion;
  for (const Gait* gait : {&Smooth(), &Plastic(), &OnSuperellipsoids()}) {
    const CriterionValues first = First(*gait), second = Second(*gait);
    for (const CriterionTraits& traits : Criteria()) {
      const double found = first[traits.criterion], rounding = 1e-4 * traits.standard;
      EXPECT_LE(second[traits.criterion], 1.003 * found + rounding) << traits.field;
      EXPECT_GE(second[traits.criterion], 0.5 * found - rounding) << traits.field;
    }
    for (const Criterion criterion : {kPositionDefect, kVelocityDefect, kPeriodicity, kEnergy, kMomentum}) {
      EXPECT_NEAR(second[criterion], first[criterion], 3e-3 * first[criterion] + 1e-4 * TraitsOf(criterion).standard)
          << TraitsOf(criterion).field;
    }
  }
}

TEST(SecondJudge, FindsAGaitThatFloatsOrSinks) {
  for (const double height : {2e-3, -2e-3}) {
    Gait gait = Smooth();
    for (TrajectoryPhase& phase : gait.trajectory.phases)
      phase.node_positions.row(JointOf(gait, "base_z")).array() += height;
    ExpectFault(gait, Smooth(), Criterion::kGap, 2e-3);
  }
  // A foot that swings touches the ground where its phase begins or ends, and sinks with the body.
  Gait gait = Smooth();
  for (TrajectoryPhase& phase : gait.trajectory.phases)
    phase.node_positions.row(JointOf(gait, "base_z")).array() -= 0.01;
  ExpectFault(gait, Smooth(), Criterion::kPenetration, 0.01);
}

TEST(SecondJudge, FindsSlip) {
  Gait gait = Smooth();
  gait.trajectory.phases[0].node_velocities(JointOf(gait, "base_x"), 4) += 0.2;
  ExpectFault(gait, Smooth(), Criterion::kSlip, 0.2);
}

TEST(SecondJudge, FindsDefects) {
  Gait gait = Smooth();
  gait.trajectory.phases[0].node_positions(JointOf(gait, "knee_l"), 5) += 0.02;
  const double found = Second(gait)[Criterion::kPositionDefect];
  EXPECT_GE(found, 0.0199);  // of the interval before; that after it starts from another state
  EXPECT_LE(found, 0.08);
  EXPECT_NEAR(First(gait)[Criterion::kPositionDefect], found, 0.01 * found);
  gait = Smooth();
  gait.trajectory.phases[0].node_velocities(JointOf(gait, "ankle_r"), 5) += 0.7;
  EXPECT_GE(Second(gait)[Criterion::kVelocityDefect], 0.69);
  EXPECT_NEAR(First(gait)[Criterion::kVelocityDefect], Second(gait)[Criterion::kVelocityDefect],
              0.01 * Second(gait)[Criterion::kVelocityDefect]);
}

TEST(SecondJudge, FindsLimitsThatAreBroken) {
  const int knee = JointOf(Smooth(), "knee_l");
  double largest = -kInfinity, fastest = 0, strongest = 0;
  int actuator = 0;
  while (Smooth().spec.scene.model.actuated()[static_cast<size_t>(actuator)] != knee) ++actuator;
  for (const TrajectoryPhase& phase : Smooth().trajectory.phases) {
    for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k) {
      const IntervalMotion interval(Smooth().trajectory, phase, k);
      for (double theta = 0; theta <= 1; theta += 1e-3) {
        largest = std::max(largest, interval.Position(theta)[knee]);
        fastest = std::max(fastest, std::abs(interval.Velocity(theta)[knee]));
        strongest = std::max(strongest, interval.Efforts(theta)[actuator]);
      }
    }
  }
  const auto shift_range = [&](Joint& joint) {
    joint.position_min = -kInfinity;
    joint.position_max = largest - 0.5;
  };
  ExpectFault(WithJoint(Smooth(), knee, shift_range), Smooth(), Criterion::kJointRange, 0.5);
  ExpectFault(WithJoint(Smooth(), knee, [&](Joint& joint) { joint.velocity_max = fastest / 4; }), Smooth(),
              Criterion::kJointVelocity, 3);
  ExpectFault(WithJoint(Smooth(), knee, [&](Joint& joint) { joint.effort_max = strongest / 1.5; }), Smooth(),
              Criterion::kJointEffort, 0.5);
}

// Forces that are stated, and those of the re-integrated motion, which stay what they were.
TEST(SecondJudge, FindsAGroundThatPulls) {
  Gait gait = Smooth();
  const double weight = gait.spec.scene.model.total_mass() * gait.spec.gravity.norm();
  TrajectoryPhase& phase = gait.trajectory.phases.back();
  phase.point_forces.row(2).segment(6, 3).array() = -0.3 * weight;
  ExpectFault(gait, Smooth(), Criterion::kPull, 0.3);
  gait = Smooth();
  gait.spec.min_normal_force_bw = 5;  // more than any gait has: the least force is what is found
  EXPECT_NEAR(Second(gait)[Criterion::kPull], First(gait)[Criterion::kPull], 1e-3);
}

TEST(SecondJudge, FindsFriction) {
  Gait gait = Smooth();
  gait.spec.friction_coefficient = 0.01;
  const double ratio = 0.01 * (1 + Second(gait)[Criterion::kFriction]);
  gait.spec.friction_coefficient = ratio / 1.3;
  ExpectFault(gait, Smooth(), Criterion::kFriction, 0.3);
}

TEST(SecondJudge, FindsASurfaceThatRisesAtTouchDown) {
  Gait gait = Plastic();
  gait.trajectory.phases.back().node_velocities.rightCols(1)(JointOf(gait, "base_z")) += 20;
  const double found = Second(gait)[Criterion::kApproach];
  EXPECT_GT(found, 10);  // it came down with a few m/s at most
  EXPECT_NEAR(First(gait)[Criterion::kApproach], found, 1e-6);
  EXPECT_LT(Second(Plastic())[Criterion::kApproach], 1e-3);
}

TEST(SecondJudge, FindsAnImpactThatIsNone) {
  Gait gait = Plastic();
  size_t jump = 0;
  while (gait.trajectory.phases[jump].impulses.size() == 0) ++jump;
  const double mass = gait.spec.scene.model.total_mass();
  gait.trajectory.phases[jump].impulses[0] += 0.3 * mass;
  ExpectFault(gait, Plastic(), Criterion::kMomentum, 0.3);
  gait = Plastic();
  gait.trajectory.phases[jump].node_velocities(JointOf(gait, "knee_r"), 0) += 3;
  EXPECT_GE(Second(gait)[Criterion::kVelocityDefect], 2.9);
}

TEST(SecondJudge, FindsAnEndThatIsNotTheStart) {
  Gait gait = Smooth();
  gait.trajectory.phases.back().node_positions.rightCols(1)(JointOf(gait, "base_pitch")) += 0.01;
  ExpectFault(gait, Smooth(), Criterion::kPeriodicity, 0.01);
}

TEST(SecondJudge, FindsEnergyAndMomentumFromNowhere) {
  Gait gait = Smooth();
  TrajectoryPhase& phase = gait.trajectory.phases.back();
  const double mass = gait.spec.scene.model.total_mass(), length = phase.node_times[3] - phase.node_times[2];
  phase.point_forces.row(2).segment(6, 3).array() += 0.2 * mass / length;
  ExpectFault(gait, Smooth(), Criterion::kMomentum, 0.2);
  gait = Smooth();
  gait.trajectory.phases.back().node_positions.rightCols(1)(JointOf(gait, "base_z")) += 0.05;
  const double found = Second(gait)[Criterion::kEnergy];
  EXPECT_GT(found, 0.1);
  EXPECT_NEAR(First(gait)[Criterion::kEnergy], found, 0.01 * found);
}

}  // namespace
}  // namespace rollgait::audit
