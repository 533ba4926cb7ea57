#include "core/models/segment_table.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

constexpr Segment kMidline[] = {Segment::kHeadNeck, Segment::kTorso, Segment::kPelvis};
constexpr Segment kLimb[] = {Segment::kUpperArm, Segment::kForearm, Segment::kHand,
                             Segment::kThigh,    Segment::kShank,   Segment::kFoot};
constexpr std::pair<Sex, double> kSamples[] = {{Sex::kFemale, 1.610}, {Sex::kMale, 1.774}};

std::vector<RigidBody> AllBodies(const SegmentTable& table) {
  std::vector<RigidBody> bodies;
  for (const Segment segment : kMidline) bodies.push_back(table.Body(segment, BodySide::kMidline));
  for (const Segment segment : kLimb) {
    bodies.push_back(table.Body(segment, BodySide::kLeft));
    bodies.push_back(table.Body(segment, BodySide::kRight));
  }
  return bodies;
}

TEST(SegmentTableTest, MassesAddUpToTheBodyMass) {
  for (const auto& [sex, stature] : kSamples) {
    double mass = 0;
    for (const RigidBody& body : AllBodies(SegmentTable(sex, stature, 68))) mass += body.mass;
    EXPECT_NEAR(mass, 68, 1e-12);
  }
}

TEST(SegmentTableTest, EverySegmentIsARigidBody) {
  for (const auto& [sex, stature] : kSamples) {
    for (const RigidBody& body : AllBodies(SegmentTable(sex, stature, 70))) {
      const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(body.inertia).eigenvalues();
      EXPECT_GT(moments(0), 0);
      // The female torso lies on the border after its projection.
      EXPECT_GE(moments(0) + moments(1), moments(2) * (1 - 1e-12)) << moments.transpose();
    }
  }
}

// The projection changes the female torso as little as it must: each principal moment by a third of the excess, which
// is 0.0133 m L² (0.12722 − 0.02955 − 0.08433, from the principal moments listed with the table).
TEST(SegmentTableTest, FemaleTorsoIsProjectedAndTheMaleIsNot) {
  const SegmentTable female(Sex::kFemale, 1.610, 62), male(Sex::kMale, 1.774, 75);
  const auto moments_over_ml2 = [](const SegmentTable& table) {
    const RigidBody torso = table.Body(Segment::kTorso, BodySide::kMidline);
    const double ml2 = torso.mass * std::pow(table.Length(Segment::kTorso), 2);
    return Vector3(Eigen::SelfAdjointEigenSolver<Matrix3>(torso.inertia).eigenvalues() / ml2);
  };
  const Vector3 female_moments = moments_over_ml2(female);
  EXPECT_NEAR(female_moments(0) + female_moments(1), female_moments(2), 1e-12);
  // Making the tensor symmetric about the sagittal plane moves the listed moments by less than 0.005.
  EXPECT_TRUE(MatrixNear(female_moments, Vector3(0.0340, 0.0888, 0.1228), 0.005));
  EXPECT_TRUE(MatrixNear(moments_over_ml2(male), Vector3(0.03484, 0.07843, 0.10054), 0.003));
}

// Right thigh of the default male, by hand from the printed row: 432 mm, 12.3 of 100.2 %, (−4.1, −42.9, 3.3) %.
TEST(SegmentTableTest, ConvertsTheAxesOfTheTable) {
  const SegmentTable table(Sex::kMale, 1.774, 100.2);
  const RigidBody thigh = table.Body(Segment::kThigh, BodySide::kRight);
  EXPECT_NEAR(thigh.mass, 12.3, 1e-12);
  EXPECT_TRUE(MatrixNear(thigh.center_of_mass, Vector3(-0.041, -0.033, -0.429) * 0.432, 1e-12));
  const double ml2 = 12.3 * 0.432 * 0.432;
  EXPECT_NEAR(thigh.inertia(0, 0), ml2 * 0.29 * 0.29, 1e-12);  // about the forward axis: XX
  EXPECT_NEAR(thigh.inertia(1, 1), ml2 * 0.30 * 0.30, 1e-12);  // about the lateral axis: ZZ
  EXPECT_NEAR(thigh.inertia(2, 2), ml2 * 0.15 * 0.15, 1e-12);  // about the long axis: YY
  EXPECT_NEAR(thigh.inertia(0, 2), ml2 * 0.07 * 0.07, 1e-12);  // XY
  EXPECT_NEAR(thigh.inertia(0, 1), ml2 * 0.02 * 0.02, 1e-12);  // −XZ, printed negative
  EXPECT_NEAR(thigh.inertia(1, 2), ml2 * 0.07 * 0.07, 1e-12);  // −YZ, printed negative
}

TEST(SegmentTableTest, LeftMirrorsRight) {
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  for (const auto& [sex, stature] : kSamples) {
    const SegmentTable table(sex, stature, 70);
    for (const Segment segment : kLimb) {
      const RigidBody left = table.Body(segment, BodySide::kLeft), right = table.Body(segment, BodySide::kRight);
      EXPECT_EQ(left.mass, right.mass);
      EXPECT_TRUE(MatrixNear(left.center_of_mass, mirror * right.center_of_mass, 0));
      EXPECT_TRUE(MatrixNear(left.inertia, mirror * right.inertia * mirror, 0));
      EXPECT_NE(right.center_of_mass.y(), 0);
    }
    for (const Segment segment : kMidline) {
      const RigidBody body = table.Body(segment, BodySide::kMidline);
      EXPECT_EQ(body.center_of_mass.y(), 0);
      EXPECT_TRUE(MatrixNear(body.inertia, mirror * body.inertia * mirror, 1e-15));
    }
    EXPECT_EQ(table.CervicalToShoulder(BodySide::kLeft), mirror * table.CervicalToShoulder(BodySide::kRight));
  }
}

TEST(SegmentTableTest, LengthsStackUpToTheStature) {
  for (const auto& [sex, stature] : kSamples) {
    for (const double scale : {0.6, 1.0, 1.3}) {
      const SegmentTable table(sex, scale * stature, 70);
      const double height = table.LegLength() - table.LumbarToHips().z() + table.Length(Segment::kTorso) +
                            table.Length(Segment::kHeadNeck);
      EXPECT_NEAR(height, scale * stature, 1e-12);
      // The pelvis of the table spans the same joints (107 and 94 mm, rounded to the millimetre).
      EXPECT_NEAR(table.LumbarToHips().norm(), table.Length(Segment::kPelvis), 1e-3 * scale);
      EXPECT_LT(table.HeelToAnkle(), table.FootLength() / 2);
    }
  }
  EXPECT_NEAR(SegmentTable(Sex::kMale, 1.774, 75).AnkleHeight(), 0.080, 1e-12);
  EXPECT_NEAR(SegmentTable(Sex::kFemale, 1.610, 62).AnkleHeight(), 0.078, 1e-12);
}

TEST(SegmentTableTest, InertiaScalesWithMassAndWithTheSquareOfStature) {
  const RigidBody one = SegmentTable(Sex::kMale, 1.5, 60).Body(Segment::kShank, BodySide::kLeft);
  const RigidBody heavy = SegmentTable(Sex::kMale, 1.5, 120).Body(Segment::kShank, BodySide::kLeft);
  const RigidBody tall = SegmentTable(Sex::kMale, 1.8, 60).Body(Segment::kShank, BodySide::kLeft);
  EXPECT_NEAR(heavy.mass, 2 * one.mass, 1e-14);
  EXPECT_EQ(heavy.center_of_mass, one.center_of_mass);
  EXPECT_TRUE(MatrixNear(heavy.inertia, 2 * one.inertia, 1e-15));
  EXPECT_EQ(tall.mass, one.mass);
  EXPECT_TRUE(MatrixNear(tall.center_of_mass, 1.2 * one.center_of_mass, 1e-15));
  EXPECT_TRUE(MatrixNear(tall.inertia, 1.44 * one.inertia, 1e-15));
}

TEST(SegmentTableTest, SourcesArePresent) {
  EXPECT_GE(SegmentTable::Sources().size(), 5u);
  for (const std::string& source : SegmentTable::Sources()) EXPECT_FALSE(source.empty());
}

}  // namespace
}  // namespace rollgait
