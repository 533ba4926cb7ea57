// The same walk in other units of time and mass: the NLP has the same objective and, in natural sizes, the same rows.
#include "core/gait/own_units.h"

#include <gtest/gtest.h>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/core/transcription/planar_request.h"

namespace rollgait {
namespace {

using Normalization = GaitRequest::Normalization;

class UnitsTest : public ::testing::TestWithParam<std::tuple<Normalization, double>> {};

TEST_P(UnitsTest, TheObjectiveOfEveryTermStays) {
  const auto [normalization, unit] = GetParam();
  const Units units{unit, 1 / unit + 0.1, 0.3};
  GaitRequest request = PlanarRequestWithEveryTerm();
  request.normalization = normalization;
  request.gravity = 3.7;
  request.body.mass = 60;
  const GaitSpec spec = CheckRequest(request).value(), scaled = InUnits(units, spec);
  EXPECT_NEAR(scaled.gravity.norm(), 3.7 * unit * unit, 1e-9);
  EXPECT_NEAR(scaled.scene.model.total_mass(), 60 / units.mass, 1e-9);
  const auto problem = BuildProblem(spec), other = BuildProblem(scaled);
  const Mesh mesh{{{0.5, 0.5}, {0.3, 0.7}}};
  CollocationNlp nlp(*problem, spec.scheme, mesh), in_unit(*other, scaled.scheme, mesh);

  // A motion with velocities, accelerations, efforts and forces, at the points of the mesh.
  VectorX x = nlp.MakeStart(WalkingGuess(spec, *problem));
  for (int i = 0; i < x.size(); ++i) x(i) += 0.02 * std::sin(7.0 * i);
  const Trajectory motion = nlp.Extract(x.data());
  const VectorX first = nlp.MakeStart(GuessFromTrajectory(motion));
  const VectorX second = in_unit.MakeStart(GuessFromTrajectory(InUnits(units, motion)));
  const VectorX a = nlp.CostIntegrals(first.data()), b = in_unit.CostIntegrals(second.data());
  ASSERT_EQ(a.size(), static_cast<int>(spec.costs.size()));
  for (int t = 0; t < a.size(); ++t) {
    const double in_seconds = spec.costs[t].weight * a(t) / nlp.Denominator(first.data());
    const double in_units = scaled.costs[t].weight * b(t) / in_unit.Denominator(second.data());
    EXPECT_GT(in_seconds, 0) << t;
    EXPECT_NEAR(units.objective * in_units, in_seconds, 1e-9 * in_seconds) << t;
  }
}

TEST_P(UnitsTest, ThereAndBack) {
  const double unit = std::get<1>(GetParam());
  GaitRequest request = PlanarRequestWithEveryTerm();
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSpec back = InUnits({1 / unit, 1 / 0.7, 1 / 0.6}, InUnits({unit, 0.7, 0.6}, spec));
  EXPECT_NEAR(back.units.time, 1, 1e-14);
  EXPECT_NEAR(back.units.mass, 1, 1e-14);
  EXPECT_NEAR(back.units.objective, 1, 1e-14);
  EXPECT_NEAR(back.similarity.mass, spec.similarity.mass, 1e-14);
  EXPECT_NEAR(back.passive_scale, spec.passive_scale, 1e-14);
  EXPECT_NEAR(back.similarity.gravity, spec.similarity.gravity, 1e-14);
  EXPECT_NEAR(back.phases[0].min_duration, spec.phases[0].min_duration, 1e-14);
  for (size_t t = 0; t < spec.costs.size(); ++t) EXPECT_NEAR(back.costs[t].weight / spec.costs[t].weight, 1, 1e-13);
  for (int j = 0; j < spec.scene.model.size(); ++j) {
    const Joint &given = spec.scene.model.joint(j), &again = back.scene.model.joint(j);
    if (!given.actuated) continue;
    EXPECT_NEAR(again.effort_max / given.effort_max, 1, 1e-14);
    EXPECT_NEAR(again.velocity_max / given.velocity_max, 1, 1e-14);
  }
}

// The name of something in which they differ in the last digit at least; empty where there is nothing.
std::string Difference(const GaitSpec& a, const GaitSpec& b) {
  for (int j = 0; j < a.scene.model.size(); ++j) {
    const Joint &x = a.scene.model.joint(j), &y = b.scene.model.joint(j);
    if (x.mass != y.mass) return x.name + " mass";
    if (x.inertia != y.inertia) return x.name + " inertia";
    if (x.center_of_mass != y.center_of_mass) return x.name + " center_of_mass";
    if (x.effort_max != y.effort_max || x.effort_min != y.effort_min) return x.name + " effort";
    if (x.velocity_max != y.velocity_max) return x.name + " velocity";
  }
  for (size_t t = 0; t < a.costs.size(); ++t) {
    if (a.costs[t].weight != b.costs[t].weight) return "cost " + std::to_string(t);
  }
  if (a.gravity != b.gravity) return "gravity";
  if (a.speed != b.speed || a.speed_range.max != b.speed_range.max) return "speed";
  if (a.passive_scale != b.passive_scale || a.scene.selection.mass != b.scene.selection.mass) return "passive torque";
  if (a.phases[0].min_duration != b.phases[0].min_duration) return "least duration";
  if (a.phases[0].max_duration != b.phases[0].max_duration) return "largest duration";
  return "";
}

// To the last digit, where units alone leave a difference.
TEST(WithoutRounding, WalksOfOneFroudeNumberAreOne) {
  for (const Preset preset : {Preset::kTorque, Preset::kTransport, Preset::kHuman}) {
    for (const char* model : {"planar", "human29"}) {
      GaitRequest request;
      request.body.model = model;
      request.body.rigid_trunk = request.body.model == "human29";
      request.preset = preset;
      request.slope = 0.1;
      request.body.mass = 75;
      request.motion.speed = 1.25;
      const GaitSpec earth = CheckRequest(request).value();
      const GaitSpec rounded = WithoutRounding(InUnits(OwnUnits(earth), earth));
      EXPECT_EQ(*rounded.speed, 1.25);
      EXPECT_NEAR(rounded.scene.model.total_mass(), earth.scene.model.total_mass(), 1e-9);
      int differ = 0;
      for (const auto& [mass, gravity] : {std::pair{37.5, 9.81}, {62.0, 9.81}, {75.0, 1.62}, {90.0, 3.71}}) {
        request.body.mass = mass;
        request.gravity = gravity;
        request.motion.speed = 1.25 * std::sqrt(gravity / 9.81);
        const GaitSpec other = CheckRequest(request).value();
        const GaitSpec in_units = InUnits(OwnUnits(other), other);
        differ += Difference(in_units, InUnits(OwnUnits(earth), earth)).empty() ? 0 : 1;
        EXPECT_EQ(Difference(WithoutRounding(in_units), rounded), "") << mass << " kg, " << gravity << " m/s²";
      }
      EXPECT_GT(differ, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Units, UnitsTest,
                         ::testing::Combine(::testing::Values(Normalization::kPerDistance, Normalization::kPerTime,
                                                              Normalization::kNone),
                                            ::testing::Values(0.4, 2.5)));

}  // namespace
}  // namespace rollgait
