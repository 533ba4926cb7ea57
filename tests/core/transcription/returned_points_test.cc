// What an explicit method returns of an interval fits its nodes.
#include "core/transcription/returned_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

TEST(ReturnedPoints, OfCollocationAreItsOwn) {
  for (const Scheme scheme : EveryCollocation()) {
    const ReturnedPoints returned = ReturnedPointsOf(scheme);
    const Tableau tableau = TableauOf(scheme);
    EXPECT_EQ(returned.scheme, scheme);
    EXPECT_EQ(returned.fractions, tableau.c);
    const MatrixX identity = MatrixX::Identity(tableau.points(), tableau.points());
    EXPECT_EQ(returned.acceleration_map, identity);
    EXPECT_EQ(returned.control_map, identity);
  }
}

class ReturnedStagesTest : public ::testing::TestWithParam<Scheme> {
 protected:
  const Tableau tableau_ = TableauOf(GetParam());
  const ReturnedPoints returned_ = ReturnedPointsOf(GetParam());
};

// With h = 1 and a state of rest before: the polynomial through the returned accelerations ends where the method does,
// and begins with the acceleration of its first stage.
TEST_P(ReturnedStagesTest, EndWhereTheMethodDoes) {
  EXPECT_EQ(returned_.scheme, Scheme::kHermiteSimpson);
  EXPECT_EQ(returned_.fractions, TableauOf(Scheme::kHermiteSimpson).c);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int run = 0; run < 20; ++run) {
    VectorX stages(tableau_.points());
    for (double& value : stages) value = uniform(random);
    double velocity = 0, position = 0;
    for (int i = 0; i < tableau_.points(); ++i) {
      velocity += tableau_.b(i) * stages(i);
      double stage_velocity = 0;
      for (int j = 0; j < i; ++j) stage_velocity += tableau_.A(i, j) * stages(j);
      position += tableau_.b(i) * stage_velocity;
    }
    const VectorX a = returned_.acceleration_map * stages;
    EXPECT_EQ(a(0), stages(0));
    EXPECT_NEAR(LagrangeIntegrals(returned_.fractions, 1).dot(a), velocity, 1e-14);
    EXPECT_NEAR(LagrangeSecondIntegrals(returned_.fractions, 1).dot(a), position, 1e-14);
  }
}

// Efforts and forces are cubic through the stages.
TEST_P(ReturnedStagesTest, HaveTheControlsOfTheStages) {
  for (int power = 0; power <= 3; ++power) {
    VectorX stages(tableau_.points());
    for (int i = 0; i < stages.size(); ++i) stages(i) = power == 0 ? 1 : std::pow(tableau_.c(i), power);
    const VectorX controls = returned_.control_map * stages;
    for (int r = 0; r < controls.size(); ++r) {
      EXPECT_NEAR(controls(r), power == 0 ? 1 : std::pow(returned_.fractions(r), power), 1e-14) << power;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ReturnedStagesTest,
                         ::testing::Values(Scheme::kShootingConstant, Scheme::kShootingLinear));

}  // namespace
}  // namespace rollgait
