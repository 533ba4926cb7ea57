#include "server/convert/warm_start_convert.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "server/convert/result_convert.h"

namespace rollgait::server {
namespace {

GaitSpec Planar() {
  GaitRequest request;
  request.body.model = "planar";
  return CheckRequest(request).value();
}

// A trajectory of the phases of the spec on two intervals each; every number differs.
Trajectory SmallTrajectory(const GaitSpec& spec) {
  Trajectory trajectory;
  trajectory.scheme = Scheme::kRadau2;
  trajectory.points_per_interval = 2;
  trajectory.point_fractions = {1.0 / 3, 1};
  trajectory.displacement = 0.7;
  double number = 0;
  const auto matrix = [&number](int rows, int columns) {
    MatrixX filled(rows, columns);
    for (int i = 0; i < filled.size(); ++i) filled.data()[i] = ++number;
    return filled;
  };
  for (const GaitSpec::Phase& described : spec.phases) {
    TrajectoryPhase& phase = trajectory.phases.emplace_back();
    phase.contacts = described.contacts;
    phase.start = trajectory.duration;
    phase.duration = 0.6;
    for (const double fraction : {0.0, 0.5, 1.0}) phase.node_times.push_back(phase.start + 0.6 * fraction);
    for (const double fraction : {1.0 / 6, 0.5, 2.0 / 3, 1.0})
      phase.point_times.push_back(phase.start + 0.6 * fraction);
    phase.node_positions = matrix(9, 3);
    phase.node_velocities = matrix(9, 3);
    phase.point_positions = matrix(9, 4);
    phase.point_velocities = matrix(9, 4);
    phase.point_accelerations = matrix(9, 4);
    phase.point_efforts = matrix(6, 4);
    phase.point_forces = matrix(3 * static_cast<int>(phase.contacts.size()), 4);
    phase.impulses = matrix(3 * static_cast<int>(phase.contacts.size()), 1);
    phase.impact_loss = ++number;
    trajectory.duration += phase.duration;
  }
  return trajectory;
}

TEST(DecodeWarmStart, IsTheInverseOfEncoding) {
  const GaitSpec spec = Planar();
  const Trajectory trajectory = SmallTrajectory(spec);
  v1::Multipliers multipliers;
  for (int i = 0; i < 5; ++i) multipliers.add_rows(0.5F * static_cast<float>(i));
  multipliers.add_bounds(-3);
  multipliers.add_between()->add_range(2);
  multipliers.mutable_between(0)->add_velocity(3);
  multipliers.mutable_between(0)->add_velocity(5);
  for (const auto& [contact, direction] : {std::pair(0, 71), std::pair(1, 0)}) {
    v1::Multipliers::FrictionEdge& edge = *multipliers.mutable_between(0)->add_friction();
    edge.set_contact(contact);
    edge.set_direction(direction);
  }
  const Result<WarmStart> decoded = DecodeWarmStart(EncodeTrajectory(trajectory, spec.scene), multipliers, spec);
  ASSERT_TRUE(decoded.ok()) << decoded.violations()[0].message;
  const Trajectory& back = decoded.value().trajectory;
  EXPECT_EQ(back.cycle, Cycle::kHalf);
  EXPECT_EQ(back.duration, trajectory.duration);
  EXPECT_EQ(back.displacement, 0.7);
  ASSERT_EQ(back.point_fractions.size(), 2u);
  EXPECT_NEAR(back.point_fractions[0], 1.0 / 3, 1e-15);
  ASSERT_EQ(back.phases.size(), trajectory.phases.size());
  for (size_t p = 0; p < back.phases.size(); ++p) {
    const TrajectoryPhase &a = back.phases[p], &b = trajectory.phases[p];
    EXPECT_EQ(a.contacts, b.contacts);
    EXPECT_EQ(a.node_times, b.node_times);
    EXPECT_EQ(a.point_times, b.point_times);
    EXPECT_EQ(a.node_positions, b.node_positions);
    EXPECT_EQ(a.node_velocities, b.node_velocities);
    EXPECT_EQ(a.point_positions, b.point_positions);
    EXPECT_EQ(a.point_velocities, b.point_velocities);
    EXPECT_EQ(a.point_accelerations, b.point_accelerations);
    EXPECT_EQ(a.point_efforts, b.point_efforts);
    EXPECT_EQ(a.point_forces, b.point_forces);
    EXPECT_EQ(a.impulses, b.impulses);
    EXPECT_EQ(a.impact_loss, b.impact_loss);
  }
  ASSERT_TRUE(decoded.value().multipliers);
  EXPECT_EQ(decoded.value().multipliers->rows.size(), 5);
  EXPECT_EQ(decoded.value().multipliers->rows(3), 1.5);
  EXPECT_EQ(decoded.value().multipliers->bounds(0), -3);
  ASSERT_EQ(decoded.value().added.between.size(), 1u);
  EXPECT_EQ(decoded.value().added.between[0], (BoundedBetween{{2}, {3, 5}, {}, {{0, 71}, {1, 0}}}));
  // Of joints, pairs, contacts or directions that do not exist, or in disorder: multipliers of another problem, which
  // are left out.
  for (const auto& spoil : std::vector<std::function<void(v1::Multipliers&)>>{
           [&](v1::Multipliers& m) { m.mutable_between(0)->add_effort(spec.scene.model.size()); },
           [](v1::Multipliers& m) { m.mutable_between(0)->add_velocity(4); },
           [](v1::Multipliers& m) { m.mutable_between(0)->set_range(0, -1); },
           [](v1::Multipliers& m) { m.add_separated(1 << 20); },
           [](v1::Multipliers& m) { m.mutable_between(0)->mutable_friction(1)->set_direction(72); },
           [](v1::Multipliers& m) { m.mutable_between(0)->mutable_friction(1)->set_direction(-1); },
           [](v1::Multipliers& m) { m.mutable_between(0)->mutable_friction(0)->set_contact(-1); },
           [](v1::Multipliers& m) { m.mutable_between(0)->mutable_friction(1)->set_contact(0); },
           [](v1::Multipliers& m) { *m.mutable_between(0)->add_friction() = m.between(0).friction(1); },
           [&](v1::Multipliers& m) {
             m.mutable_between(0)->mutable_friction(1)->set_contact(static_cast<int>(spec.scene.contacts.size()));
           },
           [](v1::Multipliers& m) {
             for (int i = 0; i < 50; ++i) m.add_between();
           }}) {
    v1::Multipliers spoiled = multipliers;
    spoil(spoiled);
    const Result<WarmStart> other = DecodeWarmStart(EncodeTrajectory(trajectory, spec.scene), spoiled, spec);
    ASSERT_TRUE(other.ok());
    EXPECT_FALSE(other.value().multipliers);
    EXPECT_EQ(other.value().added, AddedConstraints());
  }
}

// What a result carries is what a later solve starts from: the constraints that were added, whose rows the multipliers
// are of.
TEST(DecodeWarmStart, AddedConstraintsComeBackFromAResult) {
  const GaitSpec spec = Planar();
  GaitSolution solution;
  solution.trajectory = SmallTrajectory(spec);
  solution.multipliers = SolutionMultipliers{VectorX::Ones(3), VectorX::Ones(2)};
  solution.added.between = {{{1}, {}, {4, 6}, {{0, 5}, {0, 30}}}, {{}, {}, {}, {{1, 11}}}};
  const v1::SolveResult result = EncodeResult(solution, spec);
  const Result<WarmStart> decoded = DecodeWarmStart(result.trajectory(), result.multipliers(), spec);
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(decoded.value().added, solution.added);
  EXPECT_TRUE(decoded.value().multipliers);
}

TEST(DecodeWarmStart, RefusesWhatDoesNotFitTogether) {
  const GaitSpec spec = Planar();
  const v1::Trajectory good = EncodeTrajectory(SmallTrajectory(spec), spec.scene);
  const std::vector<std::function<void(v1::Trajectory&)>> faults = {
      [](v1::Trajectory& t) { t.set_joint_names(0, "tail"); },
      [](v1::Trajectory& t) { t.set_points_per_interval(0); },
      [](v1::Trajectory& t) { t.set_scheme(v1::Discretization::SCHEME_UNSPECIFIED); },
      [](v1::Trajectory& t) { t.set_scheme(v1::Discretization::SCHEME_RADAU3); },
      [](v1::Trajectory& t) { t.set_cycle(v1::CYCLE_FULL); },
      [](v1::Trajectory& t) { t.mutable_phases()->RemoveLast(); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->set_contacts(0, "hand"); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->add_node_times_s(9); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->set_node_times_s(1, 0); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->set_duration_s(0); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->add_impulses_n_s(0); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->mutable_node_positions()->set_columns(8); },
      [](v1::Trajectory& t) { t.mutable_phases(0)->mutable_point_forces()->mutable_values()->RemoveLast(); },
      [](v1::Trajectory& t) {
        t.mutable_phases(0)->mutable_point_efforts()->set_values(0, std::numeric_limits<double>::quiet_NaN());
      }};
  ASSERT_TRUE(DecodeWarmStart(good, {}, spec).ok());
  EXPECT_FALSE(DecodeWarmStart(good, {}, spec).value().multipliers);
  for (size_t i = 0; i < faults.size(); ++i) {
    v1::Trajectory bad = good;
    faults[i](bad);
    const Result<WarmStart> refused = DecodeWarmStart(bad, {}, spec);
    ASSERT_FALSE(refused.ok()) << i;
    EXPECT_EQ(refused.violations()[0].field, "warm_start") << i;
  }
}

}  // namespace
}  // namespace rollgait::server
