// The same walk in another time unit: the NLP has the same objective and, in natural sizes, the same rows.
#include "core/gait/time_unit.h"

#include <gtest/gtest.h>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/core/transcription/planar_request.h"

namespace rollgait {
namespace {

using Normalization = GaitRequest::Normalization;

class TimeUnitTest : public ::testing::TestWithParam<std::tuple<Normalization, double>> {};

TEST_P(TimeUnitTest, TheObjectiveOfEveryTermStays) {
  const auto [normalization, unit] = GetParam();
  GaitRequest request = PlanarRequestWithEveryTerm();
  request.normalization = normalization;
  request.gravity = 3.7;
  request.body.mass = 60;
  const GaitSpec spec = CheckRequest(request).value(), scaled = InTimeUnit(unit, spec);
  EXPECT_NEAR(scaled.gravity.norm(), 3.7 * unit * unit, 1e-9);
  const auto problem = BuildProblem(spec), other = BuildProblem(scaled);
  const Mesh mesh{{{0.5, 0.5}, {0.3, 0.7}}};
  CollocationNlp nlp(*problem, spec.scheme, mesh), in_unit(*other, scaled.scheme, mesh);

  // A motion with velocities, accelerations, efforts and forces, at the points of the mesh.
  VectorX x = nlp.MakeStart(WalkingGuess(spec, *problem));
  for (int i = 0; i < x.size(); ++i) x(i) += 0.02 * std::sin(7.0 * i);
  const Trajectory motion = nlp.Extract(x.data());
  const VectorX first = nlp.MakeStart(GuessFromTrajectory(motion));
  const VectorX second = in_unit.MakeStart(GuessFromTrajectory(InTimeUnit(unit, motion)));
  const VectorX a = nlp.CostIntegrals(first.data()), b = in_unit.CostIntegrals(second.data());
  ASSERT_EQ(a.size(), static_cast<int>(spec.costs.size()));
  for (int t = 0; t < a.size(); ++t) {
    const double in_seconds = spec.costs[t].weight * a(t) / nlp.Denominator(first.data());
    const double in_units = scaled.costs[t].weight * b(t) / in_unit.Denominator(second.data());
    EXPECT_GT(in_seconds, 0) << t;
    EXPECT_NEAR(in_units, in_seconds, 1e-9 * in_seconds) << t;
  }
}

TEST_P(TimeUnitTest, ThereAndBack) {
  const double unit = std::get<1>(GetParam());
  GaitRequest request = PlanarRequestWithEveryTerm();
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSpec back = InTimeUnit(1 / unit, InTimeUnit(unit, spec));
  EXPECT_NEAR(back.time_unit, 1, 1e-14);
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

INSTANTIATE_TEST_SUITE_P(Units, TimeUnitTest,
                         ::testing::Combine(::testing::Values(Normalization::kPerDistance, Normalization::kPerTime,
                                                              Normalization::kNone),
                                            ::testing::Values(0.4, 2.5)));

}  // namespace
}  // namespace rollgait
