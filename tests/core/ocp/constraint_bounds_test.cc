// The bounds of every row of a walker at an instant, by the name of the row.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/ocp/constraints/contact_point.h"
#include "core/ocp/constraints/dynamics.h"
#include "core/ocp/constraints/friction.h"

namespace rollgait {
namespace {

class ConstraintBoundsTest : public ::testing::TestWithParam<const char*> {
 protected:
  // Of the rows whose name begins so; how many there were.
  struct Expected {
    double lower, upper;
    int rows = 0;
  };

  void Check(const PointConstraint& constraint) {
    std::vector<double> lower(constraint.rows()), upper(constraint.rows());
    for (double fraction : {0.0, 0.3, 1.0}) {
      constraint.Bounds(fraction, lower.data(), upper.data());
      for (int r = 0; r < constraint.rows(); ++r) {
        const std::string name = constraint.Name(r);
        for (auto& [prefix, expected] : expected_) {
          if (!name.starts_with(prefix)) continue;
          EXPECT_EQ(lower[r], expected.lower) << name;
          EXPECT_EQ(upper[r], expected.upper) << name;
          ++expected.rows;
        }
      }
    }
  }

  std::map<std::string, Expected> expected_ = {
      {"rolling ", {0, 0}}, {"rolling acceleration", {0, 0}}, {"dynamics", {0, 0}}, {"approach", {0, kInfinity}}};
};

TEST_P(ConstraintBoundsTest, EquationsAreEquationsAndSidesAreSides) {
  GaitRequest request;
  request.body.model = GetParam();
  request.body.feet = FootShape::kTwoEllipsoids;
  request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
  const GaitSpec spec = CheckRequest(request).value();
  const auto problem = BuildProblem(spec);
  for (int phase = 0; phase < static_cast<int>(problem->phases.size()); ++phase) {
    for (const PointKind kind : {PointKind::kCollocation, PointKind::kNode, PointKind::kStage}) {
      for (const auto& constraint : problem->PointConstraints(phase, kind)) Check(*constraint);
    }
    for (const auto& constraint : problem->EntryConstraints(phase)) Check(*constraint);
    if (!problem->Jumps(phase)) continue;
    for (const auto& constraint : problem->JumpConstraints(phase)) Check(*constraint);
  }
  for (const auto& [prefix, expected] : expected_) EXPECT_GT(expected.rows, 0) << prefix;
}

TEST_P(ConstraintBoundsTest, FeetThatTouchAreOnTheGround) {
  GaitRequest request;
  request.body.model = GetParam();
  const GaitSpec spec = CheckRequest(request).value();
  const auto problem = BuildProblem(spec);
  const GapConstraint touches(problem->model, problem->contacts, 0, problem->Layout(0), GapConstraint::Kind::kTouching,
                              0);
  double lower = 1, upper = 1;
  touches.Bounds(0.4, &lower, &upper);
  EXPECT_EQ(lower, 0);
  EXPECT_EQ(upper, 0);
}

TEST_P(ConstraintBoundsTest, ForcesStayOnTheirSideOfTheCone) {
  GaitRequest request;
  request.body.model = GetParam();
  const GaitSpec spec = CheckRequest(request).value();
  const auto problem = BuildProblem(spec);
  FrictionConstraint friction(
      FrictionRows(problem->contacts, problem->ActiveContacts(0), problem->friction_coefficient, {}),
      problem->Layout(0), problem->force_size());
  std::vector<double> lower(friction.rows(), 1), upper(friction.rows(), 1);
  friction.Bounds(0.4, lower.data(), upper.data());
  EXPECT_EQ(lower, std::vector<double>(friction.rows(), 0));
  EXPECT_EQ(upper, std::vector<double>(friction.rows(), kInfinity));
}

INSTANTIATE_TEST_SUITE_P(Models, ConstraintBoundsTest, ::testing::Values("planar", "human29"));

}  // namespace
}  // namespace rollgait
