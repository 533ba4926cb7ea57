// Bodies with universal and ball joints walk: the human told so walks as the one of the list does.
#include <gtest/gtest.h>

#include "core/gait/optimizing_gait_solver.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"
#include "server/convert/result_convert.h"
#include "tests/support/ball_joints.h"

namespace rollgait::server {
namespace {

v1::SolveResult Walk(const v1::SolveSpec& request) {
  const Result<GaitSpec> spec = DecodeSpec(request);
  EXPECT_TRUE(spec.ok()) << spec.violations()[0].field << " " << spec.violations()[0].message;
  if (!spec.ok()) return {};
  return EncodeResult(OptimizingGaitSolver().Solve(spec.value(), SolveControl()), spec.value());
}

TEST(BallGait, IsThatOfTheRevoluteJoints) {
  v1::SolveSpec request;
  request.mutable_model()->set_name("human29");
  request.set_preset(v1::PRESET_TORQUE);
  request.set_slope_rad(0.03);
  const v1::SolveResult human = Walk(request);
  BodyRequest body;
  body.model = "human29";
  *request.mutable_model()->mutable_own() =
      rollgait::testing::WithBalls(EncodeModel(BuildScene(body).value(), 9.81), rollgait::testing::HumanBalls());
  request.mutable_model()->clear_name();
  const v1::SolveResult balls = Walk(request);
  ASSERT_EQ(human.termination(), v1::TERMINATION_OPTIMAL) << human.message();
  ASSERT_EQ(balls.termination(), v1::TERMINATION_OPTIMAL) << balls.message();
  EXPECT_EQ(balls.accuracy().verdict(), v1::VERDICT_WITHIN);
  // As everywhere between a model of the list and the same one written out, whose sums round otherwise.
  constexpr double kSame = 1e-9;
  EXPECT_NEAR(balls.objective(), human.objective(), kSame * human.objective());
  ASSERT_EQ(balls.trajectory().phases_size(), human.trajectory().phases_size());
  for (int p = 0; p < human.trajectory().phases_size(); ++p) {
    const auto& expected = human.trajectory().phases(p).node_positions().values();
    const auto& found = balls.trajectory().phases(p).node_positions().values();
    ASSERT_EQ(found.size(), expected.size());
    for (int i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], kSame);
  }
  // Results are told of by coordinate.
  ASSERT_EQ(balls.model().joints_size(), 29);
  for (int i = 0; i < 29; ++i) {
    EXPECT_EQ(balls.trajectory().joint_names(i), human.model().joints(i).name());
    EXPECT_EQ(balls.model().joints(i).name(), human.model().joints(i).name());
    EXPECT_EQ(balls.model().joints(i).type(), human.model().joints(i).type());
  }
}

}  // namespace
}  // namespace rollgait::server
