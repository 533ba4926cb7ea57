// People's own curves put into a trajectory come out without distance; moments against statics; peaks by hand.
#include "core/validation/normative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "core/contact/rolling_kinematics.h"
#include "core/models/planar_human.h"
#include "tests/support/prescribed_walk.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Vector3 kGravity(0, 0, -9.81);

const CurveComparison& Of(const DatasetComparison& set, NormativeQuantity quantity, std::string_view joint) {
  for (const CurveComparison& curve : set.curves) {
    if (curve.quantity == quantity && curve.joint == joint) return curve;
  }
  ADD_FAILURE() << joint;
  return set.curves.front();
}

std::vector<double> Wave(double size, double phase, double center) {
  std::vector<double> values;
  for (int i = 0; i < kNormativeSamples; ++i) {
    values.push_back(center + size * std::sin(2 * std::numbers::pi * i / kNormativeSamples + phase));
  }
  return values;
}

// The comparison of a walk with normative data.
NormativeComparison CompareWalk(const Scene& scene, const Trajectory& trajectory, const Vector3& gravity) {
  const auto events = MeasureGaitEvents(scene, trajectory, gravity);
  EXPECT_TRUE(events);
  return CompareWithPeople(scene, trajectory, *events);
}

class PeopleTest : public ::testing::TestWithParam<size_t> {
 protected:
  // The walk of a data set with its angles turned by `shift` (deg) and scaled.
  PrescribedWalk Walk(double shift, double factor) const {
    PrescribedWalk walk;
    walk.stride_time = set_.stride_time;
    walk.stride = set_.speed * set_.stride_time;
    walk.toe_off = 68;  // by then the force of both data sets is gone
    const double percent = scene_.model.total_mass() * 9.81 / 100;
    for (const NormativeCurve& curve : set_.curves) {
      std::vector<double> values = curve.mean;
      for (double& value : values) value += shift / factor;
      if (curve.quantity == NormativeQuantity::kAngle) walk.angles[curve.joint] = Through(values, factor * kDegree);
      if (curve.quantity == NormativeQuantity::kVerticalForce) walk.vertical = Through(curve.mean, percent);
      if (curve.quantity == NormativeQuantity::kForwardForce) walk.forward = Through(curve.mean, percent);
    }
    return walk;
  }
  NormativeComparison Compare(const PrescribedWalk& walk, Cycle cycle, double start) const {
    return CompareWalk(scene_, walk.Make(scene_, cycle, start), kGravity);
  }

  Scene scene_ = PlanarHuman(Sex::kFemale, 1.65, 62);
  const NormativeDataset& set_ = NormativeDatasets()[GetParam()];
};

TEST_P(PeopleTest, TheirOwnWalkHasNoDistance) {
  for (const double start : {0.0, 20.0, 50.0}) {
    const NormativeComparison people = Compare(Walk(0, 1), Cycle::kHalf, start);
    EXPECT_NEAR(people.speed, set_.speed, 1e-12);
    EXPECT_NEAR(people.cadence, 120 / set_.stride_time, 1e-9);
    EXPECT_NEAR(people.step_length, set_.speed * set_.stride_time / 2, 1e-12);
    EXPECT_NEAR(people.stance, 0.68, 1e-12);
    const DatasetComparison& own = people.datasets[GetParam()];
    EXPECT_EQ(own.dataset, set_.name);
    for (const CurveComparison& curve : own.curves) {
      if (curve.quantity == NormativeQuantity::kMoment) continue;  // a matter of dynamics, see below
      // The subject's force plates read −1.6 % of body weight at 68 %, where our foot has left the ground.
      const double zero = curve.joint == "foot" && GetParam() == 1 ? 0.5 : 1e-7;
      EXPECT_NEAR(curve.distance.rms, 0, zero) << curve.joint;
      EXPECT_NEAR(curve.distance.correlation, 1, zero / 100) << curve.joint;
      EXPECT_NEAR(curve.max, curve.normative_max, 1e-6) << curve.joint;
      if (curve.joint == "foot") continue;
      EXPECT_NEAR(curve.min, curve.normative_min, 1e-6) << curve.joint;
    }
    EXPECT_TRUE(people.peaks.two);
    EXPECT_NEAR(people.peaks.first.value(), own.peaks.first.value(), 1e-6);
    EXPECT_NEAR(people.peaks.valley.value(), own.peaks.valley.value(), 1e-6);
    EXPECT_NEAR(people.peaks.second.value(), own.peaks.second.value(), 1e-6);
  }
}

TEST_P(PeopleTest, ShiftedAndScaledWalks) {
  const NormativeComparison shifted = Compare(Walk(5, 1), Cycle::kFull, 30);
  const NormativeComparison doubled = Compare(Walk(0, 2), Cycle::kFull, 30);
  for (const char* joint : {"hip", "knee", "ankle"}) {
    const CurveComparison& far = Of(shifted.datasets[GetParam()], NormativeQuantity::kAngle, joint);
    EXPECT_NEAR(far.distance.rms, 5, 1e-6);
    EXPECT_NEAR(far.distance.correlation, 1, 1e-9);
    EXPECT_NEAR(far.max - far.min, far.normative_max - far.normative_min, 1e-6);
    const CurveComparison& wide = Of(doubled.datasets[GetParam()], NormativeQuantity::kAngle, joint);
    EXPECT_NEAR(wide.distance.correlation, 1, 1e-9);
    EXPECT_NEAR(wide.max - wide.min, 2 * (wide.normative_max - wide.normative_min), 1e-6);
  }
}

// The left leg is compared from its own heel strike on, with its own joints and foot.
TEST_P(PeopleTest, EitherLegIsComparedWithItself) {
  Trajectory walk = Walk(0, 1).Make(scene_, Cycle::kFull, 30);
  const int hip = LegJoint(scene_.model, "hip", BodySide::kLeft);
  const double turn = scene_.model.FlexionSign(hip) * 5 * kDegree;
  for (TrajectoryPhase& phase : walk.phases) phase.node_positions.row(hip).array() += turn;
  const NormativeComparison right = CompareWalk(scene_, walk, kGravity);
  const auto from_left = MeasureGaitEvents(scene_, walk, kGravity, Foot::kLeft);
  ASSERT_TRUE(from_left);
  EXPECT_EQ(from_left->First(GaitEventKind::kHeelStrike, Foot::kLeft).value(), 0);
  EXPECT_NEAR(from_left->First(GaitEventKind::kHeelStrike, Foot::kRight).value(), 50, 1e-9);
  const NormativeComparison left = CompareWithPeople(scene_, walk, *from_left, Foot::kLeft);
  EXPECT_NEAR(left.stance, right.stance, 1e-12);
  EXPECT_NEAR(left.toe_off.value(), 68, 1e-9);
  EXPECT_NEAR(left.opposite_heel_strike.value(), 50, 1e-9);
  EXPECT_NEAR(left.peaks.first.value(), right.peaks.first.value(), 1e-6);
  for (const char* joint : {"hip", "knee", "ankle"}) {
    const bool turned = std::string_view(joint) == "hip";
    const auto rms = [&](const NormativeComparison& leg) {
      return Of(leg.datasets[GetParam()], NormativeQuantity::kAngle, joint).distance.rms;
    };
    EXPECT_NEAR(rms(right), 0, 1e-6) << joint;
    EXPECT_NEAR(rms(left), turned ? 5 : 0, 1e-6) << joint;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, PeopleTest, ::testing::Values(0u, 1u));

// What our joints call positive is what the data calls positive: flexion moves the knee forward, knee flexion the ankle
// backward, dorsiflexion lifts the foot's front.
TEST(NormativeSignsTest, JointsTurnAsPeoplesDo) {
  const Scene scene = PlanarHuman(Sex::kFemale, 1.65, 62);
  const BodyDynamics dynamics(scene.model);
  BodyDynamics::State zero, turned;
  const VectorX rest = VectorX::Zero(scene.model.size());
  dynamics.ComputeState(rest, rest, &zero);
  const auto turn = [&](const char* joint) {
    VectorX q = rest;
    q[scene.model.Find(joint)] = 0.2;
    dynamics.ComputeState(q, rest, &turned);
  };
  const int knee = scene.model.Find("knee_r"), ankle = scene.model.Find("ankle_r");
  turn("hip_r");
  EXPECT_GT(turned[knee].p_WL.x(), zero[knee].p_WL.x() + 0.05);
  turn("knee_r");
  EXPECT_LT(turned[ankle].p_WL.x(), zero[ankle].p_WL.x() - 0.05);
  turn("ankle_r");
  const Vector3 front(0.1, 0, 0);
  EXPECT_GT((turned[ankle].R_WL * front).z(), 0.01);
}

// Standing still on the right foot with the efforts that the equations of motion ask for: by statics the plantarflexor
// moment is force times lever less the foot's own weight, and hip and knee differ from it by the same force at their
// own levers.
TEST(NormativeMomentsTest, AreThoseOfStatics) {
  const Scene scene = PlanarHuman(Sex::kFemale, 1.65, 62);
  const BodyDynamics dynamics(scene.model);
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  VectorX q = VectorX::Zero(scene.model.size()), moments;
  q[scene.model.Find("ankle_r")] = 0.15;  // the contact point is not below the ankle
  q[scene.model.Find("base_z")] = scene.leg_length;
  dynamics.ComputeState(q, VectorX::Zero(q.size()), &state);
  dynamics.InverseDynamics(state, VectorX::Zero(q.size()), kGravity, &workspace, &moments);
  const ContactSurface& foot = scene.contacts[scene.FindContact("right_foot")];
  const Vector3 contact = ComputeRollingContact(foot, state).p_WP;
  MatrixX jacobian = MatrixX::Zero(6, q.size());
  dynamics.AddTwistJacobian(state, foot.joint, contact, 1, &jacobian);
  moments -= jacobian.bottomRows<3>().transpose() * Vector3(0, 0, 600);

  PrescribedWalk walk;
  for (const char* joint : {"hip", "knee", "ankle"}) {
    const double angle = q[LegJoint(scene.model, joint, BodySide::kRight)];
    const double effort = moments[LegJoint(scene.model, joint, BodySide::kRight)];
    walk.angles[joint] = [angle](double) { return angle; };
    walk.efforts[joint] = [effort](double) { return effort; };
  }
  walk.stride = 0;
  walk.vertical = [](double) { return 600; };
  walk.toe_off = 60;
  const NormativeComparison people = CompareWalk(scene, walk.Make(scene, Cycle::kFull, 0), kGravity);

  const double point = contact.x();
  const auto moment = [&](const char* name) {  // lifting the heel: positive about −y of what hangs on the joint
    const int joint = scene.model.Find(name);
    const double pivot = state[joint].p_WL.x();
    double sum = 600 * (point - pivot);
    for (int link = joint; link < scene.model.size(); ++link) {
      if (!scene.model.IsAncestor(joint, link)) continue;
      const Vector3 center = state[link].p_WL + state[link].R_WL * scene.model.joint(link).center_of_mass;
      sum -= scene.model.joint(link).mass * 9.81 * (center.x() - pivot);
    }
    return sum / scene.model.total_mass();
  };
  const DatasetComparison& subject = people.datasets[1];
  ASSERT_GT(std::abs(point), 0.005);
  const int mid_stance = 15;  // 30 %
  EXPECT_NEAR(Of(subject, NormativeQuantity::kMoment, "ankle").ours[mid_stance], moment("ankle_r"), 1e-9);
  // Knee flexion turns the shank the other way than hip flexion and dorsiflexion do.
  EXPECT_NEAR(Of(subject, NormativeQuantity::kMoment, "knee").ours[mid_stance], -moment("knee_r"), 1e-9);
  EXPECT_NEAR(Of(subject, NormativeQuantity::kMoment, "hip").ours[mid_stance], moment("hip_r"), 1e-9);
}

// A spike of the polynomial's acceleration that no effort makes is no moment of the joint.
TEST(NormativeMomentsTest, NoEffortNoMoment) {
  const Scene scene = PlanarHuman(Sex::kFemale, 1.65, 62);
  PrescribedWalk walk;
  walk.angles["hip"] = [](double) { return 0; };
  walk.efforts["knee"] = [](double percent) { return 6.2 * percent; };
  Trajectory trajectory = walk.Make(scene, Cycle::kFull, 0);
  for (TrajectoryPhase& phase : trajectory.phases) phase.point_accelerations.setConstant(50);
  const DatasetComparison subject = CompareWalk(scene, trajectory, kGravity).datasets[1];
  for (int i = 0; i < kNormativeSamples; ++i) {
    EXPECT_NEAR(Of(subject, NormativeQuantity::kMoment, "hip").ours[i], 0, 1e-12);
    EXPECT_NEAR(Of(subject, NormativeQuantity::kMoment, "knee").ours[i], i == 0 ? 0 : -0.1 * 2 * i,
                1e-9);  // N m/kg at 62 kg
  }
}

TEST(NormativeSlopeTest, VerticalIsAgainstGravity) {
  const Scene scene = PlanarHuman(Sex::kFemale, 1.65, 62);
  const double slope = 0.17, weight = scene.model.total_mass() * 9.81;
  PrescribedWalk walk;
  walk.angles["hip"] = [](double) { return 0; };
  walk.vertical = [&](double) { return weight * std::cos(slope); };
  walk.forward = [&](double) { return weight * std::sin(slope); };
  const Vector3 gravity = 9.81 * Vector3(-std::sin(slope), 0, -std::cos(slope));
  const NormativeComparison people = CompareWalk(scene, walk.Make(scene, Cycle::kHalf, 10), gravity);
  EXPECT_NEAR(Of(people.datasets[0], NormativeQuantity::kVerticalForce, "foot").ours[10], 100, 1e-9);
  EXPECT_NEAR(Of(people.datasets[0], NormativeQuantity::kForwardForce, "foot").ours[10], 0, 1e-9);
}

TEST(NormativeRestingTest, NamesTheJointTheEndAndTheShare) {
  const Scene scene = PlanarHuman(Sex::kFemale, 1.65, 62);
  const double end = scene.model.joint(scene.model.Find("ankle_r")).position_max;
  PrescribedWalk walk;
  walk.angles["hip"] = [](double) { return 0.1; };
  walk.angles["knee"] = [](double) { return 0.2; };
  walk.angles["ankle"] = [&](double percent) { return percent < 15 ? end : 0; };  // a quarter of stance
  const NormativeComparison people = CompareWalk(scene, walk.Make(scene, Cycle::kFull, 0), kGravity);
  ASSERT_EQ(people.resting.size(), 1u);
  EXPECT_EQ(people.resting[0].joint, "ankle_r");
  EXPECT_TRUE(people.resting[0].at_max);
  EXPECT_NEAR(people.resting[0].share, 0.25, 0.02);  // half a per cent of the cycle between nodes
}

TEST(CurveDistanceTest, KnownAnswers) {
  const std::vector<double> wave = Wave(10, 0, 3), deviation = Wave(1, 0.3, 2);
  std::vector<double> off = wave;
  for (size_t i = 0; i < off.size(); ++i) off[i] += deviation[i];
  EXPECT_NEAR(MeasureDistance(off, wave, deviation).rms_deviations, 1, 1e-12);
  EXPECT_NEAR(MeasureDistance(Wave(10, std::numbers::pi / 2, 3), wave, deviation).correlation, 0, 1e-12);
  EXPECT_NEAR(MeasureDistance(Wave(10, std::numbers::pi / 3, 3), wave, deviation).correlation, 0.5, 1e-12);
  EXPECT_NEAR(MeasureDistance(Wave(-4, 0, 3), wave, deviation).correlation, -1, 1e-12);
  EXPECT_NEAR(MeasureDistance(Wave(14, 0, 3), wave, deviation).rms, 4 / std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(MeasureDistance(wave, wave, std::vector<double>(wave.size(), 0)).rms_deviations, kInfinity);
  EXPECT_EQ(MeasureDistance(std::vector<double>(wave.size(), 2), wave, deviation).correlation, 0);
}

TEST(ForcePeaksTest, ByHand) {
  const ForcePeaks two = FindForcePeaks({0, 50, 110, 90, 70, 80, 105, 60, 0}, 5);
  EXPECT_TRUE(two.two);
  EXPECT_EQ(two.first, 110);
  EXPECT_EQ(two.valley, 70);
  EXPECT_EQ(two.second, 105);
  EXPECT_FALSE(FindForcePeaks({0, 50, 110, 105, 103, 104, 107, 60, 0}, 5).two);  // too shallow
  const ForcePeaks one = FindForcePeaks({0, 20, 50, 80, 100, 80, 50, 20, 0}, 5);
  EXPECT_FALSE(one.first);
  EXPECT_FALSE(one.two);
  EXPECT_FALSE(FindForcePeaks({150, 120, 110, 90, 70, 80, 105, 60, 0}, 5).first);  // falls from the first instant on
}

}  // namespace
}  // namespace rollgait
