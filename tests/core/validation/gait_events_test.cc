// Walks whose contacts and forces are prescribed, cut at several places: events, shares, forces and centres of pressure
// are known.
#include "core/validation/gait_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/rolling_kinematics.h"
#include "core/models/catalog.h"
#include "tests/support/prescribed_walk.h"

namespace rollgait {
namespace {

constexpr double kWeight = 700;  // N, normal force on a standing foot

Scene Body(const std::string& model, FootShape feet, bool toes) {
  BodyRequest request;
  request.model = model;
  request.feet = feet;
  request.toes = toes;
  return BuildScene(request).value();
}

// When a surface of the right foot is on the ground, % of the cycle; the left foot is half a cycle later, or as asked.
struct Timing {
  std::string surface;  // without "right_"
  double on, off;
};

// A walk with straight legs and these timings; each standing surface carries kWeight · (1 + its index in `timings`).
class TimedWalk {
 public:
  TimedWalk(const Scene& scene, std::vector<Timing> timings, double left_later = 50)
      : scene_(scene), timings_(std::move(timings)), left_later_(left_later) {}

  Trajectory Make(Cycle cycle, double start) const {
    Trajectory t;
    t.point_fractions = {1.0 / 3, 1};
    t.cycle = cycle;
    const double span = cycle == Cycle::kHalf ? 50 : 100;
    t.duration = span / 100;
    t.displacement = 1.4 * span / 100;
    double at = start;
    while (at < start + span - 1e-9) {
      double end = start + span;
      for (const Timing& timing : timings_) {
        for (const double border : {timing.on, timing.off}) {
          for (const double later : {0.0, left_later_}) {
            for (double shifted = border + later - 200; shifted < end; shifted += 100) {
              if (shifted > at + 1e-9) end = std::min(end, shifted);
            }
          }
        }
      }
      t.phases.push_back(Phase(start, at, end));
      at = end;
    }
    return t;
  }

 private:
  TrajectoryPhase Phase(double origin, double begin, double end) const {
    TrajectoryPhase phase;
    std::vector<double> loads;
    const double middle = (begin + end) / 2;
    for (const char* side : {"left_", "right_"}) {
      const double own = std::fmod(middle + (side[0] == 'l' ? 100 - left_later_ : 0), 100);
      for (size_t i = 0; i < timings_.size(); ++i) {
        if (own < timings_[i].on || own > timings_[i].off) continue;
        phase.contacts.push_back(scene_.FindContact(side + timings_[i].surface));
        loads.push_back(kWeight * static_cast<double>(i + 1));
      }
    }
    const int joints = scene_.model.size();
    phase.start = (begin - origin) / 100;
    phase.duration = (end - begin) / 100;
    phase.node_times = {phase.start, phase.start + phase.duration};
    phase.node_positions = phase.node_velocities = MatrixX::Zero(joints, 2);
    for (int k = 0; k < 2; ++k) {
      phase.node_positions(scene_.model.Find("base_x"), k) = 1.4 * phase.node_times[k];
      phase.node_positions(scene_.model.Find("base_z"), k) = scene_.leg_length;
    }
    phase.node_velocities.row(scene_.model.Find("base_x")).setConstant(1.4);
    phase.point_accelerations = MatrixX::Zero(joints, 2);
    phase.point_efforts = MatrixX::Zero(static_cast<int>(scene_.model.actuated().size()), 2);
    phase.point_forces = MatrixX::Zero(3 * static_cast<int>(loads.size()), 2);
    for (size_t c = 0; c < loads.size(); ++c) {
      phase.point_forces.row(3 * static_cast<int>(c)).setConstant(0.1 * loads[c]);
      phase.point_forces.row(3 * static_cast<int>(c) + 2).setConstant(loads[c]);
    }
    return phase;
  }

  const Scene& scene_;
  std::vector<Timing> timings_;
  double left_later_;  // % of the cycle
};

struct Expected {
  GaitEventKind kind;
  Foot foot;
  double percent;
};

void ExpectEvents(const GaitEvents& events, const std::vector<Expected>& expected) {
  ASSERT_EQ(events.events.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(events.events[i].kind, expected[i].kind) << i;
    EXPECT_EQ(events.events[i].foot, expected[i].foot) << i;
    EXPECT_NEAR(events.events[i].percent, expected[i].percent, 1e-9) << i;
  }
}

struct Case {
  std::string model;
  Cycle cycle;
  double start;
};

class TwoSurfacesTest : public ::testing::TestWithParam<Case> {};

// Heel on 0 … 38 %, forefoot 7 … 61 %.
TEST_P(TwoSurfacesTest, AFootIsOneFoot) {
  const auto& [model, cycle, start] = GetParam();
  const Scene scene = Body(model, FootShape::kTwoEllipsoids, false);
  const Trajectory trajectory = TimedWalk(scene, {{"heel", 0, 38}, {"forefoot", 7, 61}}).Make(cycle, start);
  const auto events = MeasureGaitEvents(scene, trajectory, {0, 0, -9.81});
  ASSERT_TRUE(events);
  using enum GaitEventKind;
  ExpectEvents(*events, {{kHeelStrike, Foot::kRight, 0},
                         {kFootFlat, Foot::kRight, 7},
                         {kToeOff, Foot::kLeft, 11},
                         {kHeelOff, Foot::kRight, 38},
                         {kHeelStrike, Foot::kLeft, 50},
                         {kFootFlat, Foot::kLeft, 57},
                         {kToeOff, Foot::kRight, 61},
                         {kHeelOff, Foot::kLeft, 88}});
  EXPECT_NEAR(events->foot(Foot::kRight).stance, 0.61, 1e-12);
  EXPECT_NEAR(events->foot(Foot::kLeft).stance, 0.61, 1e-12);
  EXPECT_NEAR(events->double_support, 0.22, 1e-12);
  EXPECT_NEAR(events->single_support, 0.78, 1e-12);
  EXPECT_NEAR(events->flight, 0, 1e-12);
  EXPECT_NEAR(events->duration, 1, 1e-12);
  EXPECT_NEAR(events->displacement, 1.4, 1e-12);
}

// The sum over the surfaces of a foot, and its centre of pressure between them.
TEST_P(TwoSurfacesTest, ForcesAreSumsAndPressureHasACentre) {
  const auto& [model, cycle, start] = GetParam();
  const Scene scene = Body(model, FootShape::kTwoEllipsoids, false);
  const Trajectory trajectory = TimedWalk(scene, {{"heel", 0, 38}, {"forefoot", 7, 61}}).Make(cycle, start);
  const auto events = MeasureGaitEvents(scene, trajectory, {0, 0, -9.81});
  ASSERT_TRUE(events);
  const BodyDynamics dynamics(scene.model);
  BodyDynamics::State state;
  const auto cycle_of = GaitCycle::Of(scene, trajectory);
  for (int i = 1; i < kCycleSteps; i += 3) {  // not at an event
    const double percent = 100.0 * i / kCycleSteps;
    const MotionSample sample = cycle_of->At(percent);
    dynamics.ComputeState(sample.position, sample.velocity, &state);
    for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
      const FootOnGround& measured = events->foot(foot);
      const double own = std::fmod(percent + (foot == Foot::kLeft ? 50 : 0), 100);
      const double heel = own < 38 ? kWeight : 0, front = own > 7 && own < 61 ? 2 * kWeight : 0;
      EXPECT_NEAR(measured.force(2, i), heel + front, 1e-9) << percent;
      EXPECT_NEAR(measured.force(0, i), 0.1 * (heel + front), 1e-9) << percent;
      EXPECT_TRUE(measured.level_force.col(i).isApprox(measured.force.col(i), 1e-14)) << percent;
      const std::string side = foot == Foot::kRight ? "right_" : "left_";
      const auto place = [&](const char* surface) {
        return ComputeRollingContact(scene.contacts[scene.FindContact(side + surface)], state).p_WP;
      };
      if (heel + front == 0) {
        EXPECT_TRUE(std::isnan(measured.center_of_pressure(0, i))) << percent;
        continue;
      }
      const Vector3 center = (heel * place("heel") + front * place("forefoot")) / (heel + front);
      EXPECT_TRUE(measured.center_of_pressure.col(i).isApprox(center.head<2>(), 1e-12)) << percent;
      EXPECT_GT(place("forefoot").x() - place("heel").x(), 0.05);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cuts, TwoSurfacesTest,
                         ::testing::Values(Case{"planar", Cycle::kFull, 0}, Case{"planar", Cycle::kFull, 45},
                                           Case{"planar", Cycle::kHalf, 0}, Case{"planar", Cycle::kHalf, 23},
                                           Case{"planar", Cycle::kHalf, 55}, Case{"human29", Cycle::kHalf, 23},
                                           Case{"human29", Cycle::kFull, 71}));

// Legs are straight and feet below the hips: a foot comes down where the body is.
TEST(GaitEventsTest, StepsOfBothFeet) {
  const Scene scene = Body("planar", FootShape::kTwoEllipsoids, false);
  for (const double start : {0.0, 20.0, 44.0}) {
    const TimedWalk walk(scene, {{"heel", 0, 38}, {"forefoot", 7, 61}}, 44);
    const auto events = MeasureGaitEvents(scene, walk.Make(Cycle::kFull, start), {0, 0, -9.81});
    ASSERT_TRUE(events);
    const FootOnGround &right = events->foot(Foot::kRight), &left = events->foot(Foot::kLeft);
    EXPECT_NEAR(left.step_duration, 0.44, 1e-12);
    EXPECT_NEAR(right.step_duration, 0.56, 1e-12);
    EXPECT_NEAR(left.step_length, 1.4 * 0.44, 1e-12);
    EXPECT_NEAR(right.step_length, 1.4 * 0.56, 1e-12);
    EXPECT_NEAR(right.loading, 0.05, 1e-12);  // the left foot leaves at 105 %
    EXPECT_NEAR(left.loading, 0.17, 1e-12);
    EXPECT_NEAR(events->StepLengthAsymmetry(), 0.12 / 0.5, 1e-11);
    EXPECT_NEAR(events->StepDurationAsymmetry(), 0.12 / 0.5, 1e-11);
    EXPECT_NEAR(events->StanceAsymmetry(), 0, 1e-11);
  }
}

// The foremost surface rides on the toes: three links of a leg, one foot.
TEST(GaitEventsTest, ToesBelongToTheFoot) {
  const Scene scene = Body("human29", FootShape::kTwoEllipsoids, true);
  ASSERT_NE(scene.contacts[scene.FindContact("right_heel")].joint,
            scene.contacts[scene.FindContact("right_forefoot")].joint);
  const Trajectory trajectory = TimedWalk(scene, {{"heel", 0, 38}, {"forefoot", 7, 61}}).Make(Cycle::kHalf, 30);
  const auto events = MeasureGaitEvents(scene, trajectory, {0, 0, -9.81});
  ASSERT_TRUE(events);
  EXPECT_EQ(events->First(GaitEventKind::kHeelOff, Foot::kRight), 38);
  EXPECT_NEAR(events->First(GaitEventKind::kToeOff, Foot::kRight).value(), 61, 1e-9);
  EXPECT_NEAR(events->double_support, 0.22, 1e-12);
}

// One surface a foot: there is no flat foot; a flight between the steps counts as none of the supports.
TEST(GaitEventsTest, OneSurfaceAFootAndFlight) {
  const Scene scene = Body("planar", FootShape::kOneEllipsoid, false);
  const Trajectory trajectory = TimedWalk(scene, {{"foot", 0, 40}}).Make(Cycle::kHalf, 20);
  const auto events = MeasureGaitEvents(scene, trajectory, {0, 0, -9.81});
  ASSERT_TRUE(events);
  using enum GaitEventKind;
  ExpectEvents(*events, {{kHeelStrike, Foot::kRight, 0},
                         {kToeOff, Foot::kRight, 40},
                         {kHeelStrike, Foot::kLeft, 50},
                         {kToeOff, Foot::kLeft, 90}});
  EXPECT_NEAR(events->flight, 0.2, 1e-12);
  EXPECT_NEAR(events->single_support, 0.8, 1e-12);
  EXPECT_EQ(events->double_support, 0);
}

// On a slope the level axes turn with gravity; a normal force has a part backward on the way up.
TEST(GaitEventsTest, LevelAxesFollowGravity) {
  const Scene scene = Body("planar", FootShape::kOneEllipsoid, false);
  const Trajectory trajectory = TimedWalk(scene, {{"foot", 0, 60}}).Make(Cycle::kFull, 0);
  const double slope = 0.2;
  const auto events = MeasureGaitEvents(scene, trajectory, 9.81 * Vector3(-std::sin(slope), 0, -std::cos(slope)));
  ASSERT_TRUE(events);
  const Vector3 level = events->foot(Foot::kRight).level_force.col(60);
  EXPECT_NEAR(level.x(), kWeight * (0.1 * std::cos(slope) - std::sin(slope)), 1e-9);
  EXPECT_NEAR(level.z(), kWeight * (0.1 * std::sin(slope) + std::cos(slope)), 1e-9);
  EXPECT_NEAR(events->body_weight, 9.81 * scene.model.total_mass(), 1e-9);
}

}  // namespace
}  // namespace rollgait
