// Derivatives of pairs against eighth-order differences of the definition: contact points solved anew at every
// displaced configuration.
#include "core/contact/pair_derivatives.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/displaced_frames.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using Vector10 = Eigen::Matrix<double, 10, 1>;

Vector10 Stack(const PairKinematics& pair) {
  Vector10 stack;
  stack << pair.normal, pair.p_1, pair.p_2, pair.gap;
  return stack;
}

Vector10 First(const PairDerivatives& derivatives, const Vector12& u) {
  Vector10 stack;
  stack << derivatives.normal * u, derivatives.p_1 * u, derivatives.p_2 * u, derivatives.gap * u;
  return stack;
}

Vector10 Second(const PairDerivatives& derivatives, const Vector12& u) {
  Vector10 stack;
  for (int i = 0; i < 3; ++i) {
    stack[i] = u.dot(derivatives.normal_second[i] * u);
    stack[3 + i] = u.dot(derivatives.p_1_second[i] * u);
    stack[6 + i] = u.dot(derivatives.p_2_second[i] * u);
  }
  stack[9] = u.dot(derivatives.gap_second * u);
  return stack;
}

// Differences with a step of 0.0015 rad and m over functions that change over 0.05 and more (overlapping bodies move
// their normal fast): truncation (0.03)⁸ · 30 of the value; rounding of Newton's method 10 ε over 0.0015 and 0.0015².
constexpr double kStep = 0.0015, kFirstTolerance = 1e-10, kSecondTolerance = 3e-8;

template <typename Evaluate>
void CheckAgainstDifferences(const Evaluate& evaluate, const PairDerivatives& derivatives, SeededRandom* random) {
  ASSERT_EQ(derivatives.order, 2);
  for (int i = 0; i < 12; ++i) {
    const Vector12 u = random->VectorOf(12, -0.5, 0.5);
    const auto along = [&](double t) { return evaluate(t * u); };
    const Vector10 first = First(derivatives, u), second = Second(derivatives, u);
    EXPECT_TRUE(MatrixNear(HighOrderDifference(along, kStep), first, kFirstTolerance * (1 + first.norm())));
    EXPECT_TRUE(MatrixNear(HighOrderSecondDifference(along, kStep), second, kSecondTolerance * (1 + second.norm())));
    EXPECT_GT(first.norm(), 1e-3);
    EXPECT_GT(second.norm(), 1e-3);
  }
  for (int i = 0; i < 3; ++i) EXPECT_EQ(derivatives.p_1_second[i], derivatives.p_1_second[i].transpose());
}

TEST(PairDerivativesTest, SurfacesAgreeWithDifferences) {
  SeededRandom random(31);
  for (const Surface& first : SmoothBodies()) {
    for (const double distance : {3.0, 0.9}) {  // apart, and overlapping
      const TwoBodies at(first, distance, &random);
      ASSERT_EQ(at.separation.state, distance > 2 ? Separation::State::kSeparated : Separation::State::kOverlap);
      SurfacePair pair(at.one, at.two);
      const auto evaluate = [&](const Vector12& z) {
        pair.StartFrom(at.separation.nu);
        return Stack(pair.Compute(Displaced(at.body_1, z.segment<3>(0), z.segment<3>(3)),
                                  Displaced(at.body_2, z.segment<3>(6), z.segment<3>(9))));
      };
      CheckAgainstDifferences(
          evaluate, ComputeSurfacePairDerivatives(at.one, at.body_1, at.two, at.body_2, at.separation, 2), &random);
    }
  }
}

TEST(PairDerivativesTest, PlanesAgreeWithDifferences) {
  SeededRandom random(37);
  for (const Surface& surface : SmoothBodies()) {
    const PlacedSurface placed{surface, {0.1, 0.2, -0.1}, ExtremeContacts::Turn({0.3, -0.2, 0.5})};
    const PlacedPlane plane{{0.3, 0.1, -0.2}, random.Unit()};
    const FrameMotion body = RandomFrame(&random, {0, 0, 2}), ground = RandomFrame(&random, {0.3, 0, 0});
    const auto evaluate = [&](const Vector12& z) {
      return Stack(ComputePlaneContact(placed, Displaced(body, z.segment<3>(0), z.segment<3>(3)), plane,
                                       Displaced(ground, z.segment<3>(6), z.segment<3>(9))));
    };
    CheckAgainstDifferences(evaluate, ComputePlaneDerivatives(placed, body, plane, ground, 2), &random);
  }
}

// Velocities are the derivatives times the twists; the drift at zero accelerations is theirs, too.
TEST(PairDerivativesTest, TwistsGiveTheVelocitiesOfTheKinematics) {
  SeededRandom random(41);
  const PlacedSurface one{Ellipsoid({0.8, 1.2, 0.5}), {0.1, 0.2, -0.1}, ExtremeContacts::Turn({0.3, -0.2, 0.5})};
  const PlacedSurface two{Ellipsoid({0.7, 0.5, 0.9}), {-0.2, 0.1, 0.3}, ExtremeContacts::Turn({-0.4, 0.6, 0.1})};
  const PlacedPlane plane{{0.3, 0.1, -0.2}, random.Unit()};
  FrameMotion body_1 = RandomFrame(&random, {0, 0, 0}), body_2 = RandomFrame(&random, {0.4, 3, 0.2});
  for (FrameMotion* body : {&body_1, &body_2}) body->v_WB = random.Vector(-1, 1), body->w_WB = random.Vector(-1, 1);
  Vector12 twists;
  twists << body_1.v_WB, body_1.w_WB, body_2.v_WB, body_2.w_WB;
  SurfacePair pair(one, two);
  const PairKinematics surfaces = pair.Compute(body_1, body_2);
  const PairKinematics flat = ComputePlaneContact(one, body_1, plane, body_2);
  const PairDerivatives of_surfaces = ComputeSurfacePairDerivatives(one, body_1, two, body_2, pair.separation(), 2);
  const PairDerivatives of_plane = ComputePlaneDerivatives(one, body_1, plane, body_2, 2);
  for (const bool is_plane : {false, true}) {
    const PairKinematics& kinematics = is_plane ? flat : surfaces;
    const PairDerivatives& derivatives = is_plane ? of_plane : of_surfaces;
    Vector10 expected;
    expected << kinematics.normal_dot, kinematics.p_dot_1, kinematics.p_dot_2, kinematics.gap_rate;
    EXPECT_TRUE(MatrixNear(First(derivatives, twists), expected, 1e-13));
    const Vector3 p_dot_2 = is_plane ? kinematics.p_dot_1 : kinematics.p_dot_2;
    EXPECT_TRUE(MatrixNear(body_1.w_WB.cross(Vector3(derivatives.p_1 * twists - body_1.v_WB)) -
                               body_2.w_WB.cross(Vector3(p_dot_2 - body_2.v_WB)),
                           kinematics.drift, 1e-13));
    // Along constant twists the frames have no acceleration, so this is the second derivative of the gap.
    EXPECT_NEAR(twists.dot(derivatives.gap_second * twists), kinematics.gap_acceleration, 1e-12);
  }
}

TEST(PairDerivativesTest, AFlatSurfaceHasNone) {
  const PlacedSurface box{Superellipsoid(Vector3(0.5, 0.4, 0.3), 0.5, 0.5), Vector3::Zero(), Matrix3::Identity()};
  FrameMotion body, ground;
  body.p_WB.z() = 0.3;
  const PairDerivatives derivatives = ComputePlaneDerivatives(box, body, {}, ground, 2);
  EXPECT_EQ(derivatives.order, 0);
  EXPECT_EQ(derivatives.gap[2], kInfinity);
  EXPECT_EQ(derivatives.gap_second(0, 0), kInfinity);
}

}  // namespace
}  // namespace rollgait
