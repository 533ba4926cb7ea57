// Overlap of two bodies: planted depths, bodies in closed form, and the project's other algorithm for the same.
#include "core/validation/body_overlap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/contact/pair_separation.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

PosedBody RandomEllipsoid(SeededRandom& random) {
  const Eigen::Quaterniond turn(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                                random.Uniform(-1, 1));
  PosedBody body;
  body.R_WE = turn.normalized().toRotationMatrix();
  body.semi_axes = {random.LogUniform(0.02, 0.3), random.LogUniform(0.02, 0.3), random.LogUniform(0.02, 0.3)};
  return body;
}

std::shared_ptr<const std::function<double(const Vector3&)>> NormOf(const SmoothSuperellipsoid& body) {
  return std::make_shared<const std::function<double(const Vector3&)>>(body.Walking().support);
}

// The point of the body furthest along nu, from its centre.
Vector3 FurthestAlong(const PosedBody& body, const Vector3& nu) {
  const Vector3 local = body.semi_axes.cwiseProduct(body.R_WE.transpose() * nu);
  return body.R_WE * (body.semi_axes.cwiseProduct(local) / local.norm());
}

// Moves b to where it touches a at the normal nu and overlaps it by `depth` along nu.
void PlaceAt(double depth, const Vector3& nu, const PosedBody& a, PosedBody* b) {
  b->p_WE = a.p_WE + FurthestAlong(a, nu) - FurthestAlong(*b, -nu) - depth * nu;
}

TEST(BodyOverlapTest, SpheresAndAlignedEllipsoidsInClosedForm) {
  PosedBody a, b;
  a.semi_axes = Vector3::Constant(0.3);
  b.semi_axes = Vector3::Constant(0.2);
  const Vector3 direction(0.48, 0.6, 0.64);
  for (const double distance : {0.1, 0.4, 0.499, 0.4999999}) {
    b.p_WE = distance * direction;
    EXPECT_NEAR(OverlapDepth(a, b), 0.5 - distance, 1e-11);
    EXPECT_NEAR(FindScaledContact(a, b).scale, distance / 0.5, 1e-12);
    EXPECT_LT((FindScaledContact(a, b).nu - direction).norm(), 1e-9);
  }
  b.p_WE = 0.5000001 * direction;
  EXPECT_EQ(OverlapDepth(a, b), 0);
  EXPECT_GT(FindScaledContact(a, b).scale, 1);
  // Two plates beside each other, of which one is 15 mm above the other: up is the shortest way out, not sideways.
  a.semi_axes = b.semi_axes = Vector3(0.1, 0.1, 0.01);
  b.p_WE = Vector3(0.04, 0, 0.015);
  const double up = OverlapDepth(a, b);
  EXPECT_GT(up, 0.0);
  EXPECT_LT(up, 0.005);
  // The same centre: the way out is along the shortest axes.
  b.p_WE.setZero();
  EXPECT_NEAR(OverlapDepth(a, b), 0.02, 1e-11);
}

// At depth d the shortest translation differs from the planted one by d² over a radius of curvature; the least is 1 mm
// here.
TEST(BodyOverlapTest, FindsPlantedDepths) {
  SeededRandom random(3);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const PosedBody a = RandomEllipsoid(random);
    PosedBody b = RandomEllipsoid(random);
    const Vector3 nu = random.Unit();
    for (const double depth : {1e-8, 1e-6, 2e-5}) {
      PlaceAt(depth, nu, a, &b);
      EXPECT_NEAR(OverlapDepth(a, b), depth, 2e-9 + depth * depth / 1e-3) << i;
      EXPECT_LT(FindScaledContact(a, b).scale, 1);
      PlaceAt(-depth, nu, a, &b);
      EXPECT_EQ(OverlapDepth(a, b), 0);
      EXPECT_GT(FindScaledContact(a, b).scale, 1);
      ++found;
    }
  }
  EXPECT_EQ(found, 900);
}

// The Newton method of the pairs: the same answer to whether bodies overlap, and how deep.
TEST(BodyOverlapTest, AgreesWithTheSeparationOfPairs) {
  SeededRandom random(5);
  int apart = 0, overlapping = 0, shorter = 0;
  for (int i = 0; i < 1000; ++i) {
    PosedBody a = RandomEllipsoid(random), b = RandomEllipsoid(random);
    b.p_WE = random.Vector(-0.25, 0.25);
    const Surface one = Ellipsoid(a.semi_axes), two = Ellipsoid(b.semi_axes);
    const Separation separation = FindSeparation({&one, a.R_WE, a.p_WE}, {&two, b.R_WE, b.p_WE}, nullptr);
    const ScaledContact contact = FindScaledContact(a, b);
    ASSERT_NE(separation.state, Separation::State::kTouching);
    EXPECT_EQ(separation.state == Separation::State::kOverlap, contact.scale < 1) << i;
    const double plane = PlaneDistance(a, b, contact.nu);
    EXPECT_LE(plane, separation.distance + 1e-14);
    EXPECT_EQ(plane > 0, contact.scale > 1);
    const double depth = OverlapDepth(a, b);
    if (separation.distance > 0) {
      EXPECT_EQ(depth, 0);
      ++apart;
      continue;
    }
    ++overlapping;
    // Both look for the shortest of several ways out, from different starts.
    EXPECT_LT(depth, -separation.distance + 1e-9) << i;
    shorter += depth < -separation.distance - 1e-9;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(overlapping, 100);
  EXPECT_LT(shorter, overlapping / 20);
}

// Superellipsoids: the judge's own support function is that of the surface that is judged, and so are distances.
TEST(BodyOverlapTest, OfSuperellipsoidsAgreesWithTheSeparationOfPairs) {
  SeededRandom random(11);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    PosedBody a = RandomEllipsoid(random), b = RandomEllipsoid(random);
    b.p_WE = random.Vector(-0.3, 0.3);
    const double e_1 = random.Uniform(0.6, 1.6), e_2 = random.Uniform(0.6, 1.6);
    const SmoothSuperellipsoid super(a.semi_axes, e_1, e_2, 0.1);
    a.norm = NormOf(SmoothSuperellipsoid(a.semi_axes, e_1, e_2, 0.1));
    Surface one = super, two = Ellipsoid(b.semi_axes);
    if (i % 2 == 0) {
      two = SmoothSuperellipsoid(b.semi_axes, e_2, e_1, 0.1);
      b.norm = NormOf(SmoothSuperellipsoid(b.semi_axes, e_2, e_1, 0.1));
    }
    const Vector3 nu = random.Unit();
    EXPECT_NEAR((*a.norm)(nu), one.Support(nu), 1e-14);
    const Separation separation = FindSeparation({&one, a.R_WE, a.p_WE}, {&two, b.R_WE, b.p_WE}, nullptr);
    const ScaledContact contact = FindScaledContact(a, b);
    ASSERT_NE(separation.state, Separation::State::kTouching);
    EXPECT_EQ(separation.state == Separation::State::kOverlap, contact.scale < 1) << i;
    const double plane = PlaneDistance(a, b, contact.nu);
    EXPECT_LE(plane, separation.distance + 1e-14);
    EXPECT_EQ(plane > 0, contact.scale > 1) << i;
    const double depth = OverlapDepth(a, b);
    if (separation.distance > 0) {
      EXPECT_EQ(depth, 0);
      ++apart;
    } else {
      EXPECT_LT(depth, -separation.distance + 1e-9) << i;
      EXPECT_GT(depth, 0) << i;
      ++overlapping;
    }
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(overlapping, 50);
}

TEST(BodyOverlapTest, WhatIsNoNumberIsNoDistance) {
  PosedBody a, b;
  b.p_WE = Vector3(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_EQ(OverlapDepth(a, b), kInfinity);
}

}  // namespace
}  // namespace rollgait
