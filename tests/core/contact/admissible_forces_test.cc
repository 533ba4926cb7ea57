#include "core/contact/admissible_forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using Eigen::Vector2d;

Vector6 Wrench(const std::vector<LinkContact>& contacts) {
  Vector6 wrench = Vector6::Zero();
  for (const LinkContact& contact : contacts) {
    wrench.head<3>() += contact.force;
    wrench.tail<3>() += contact.point.cross(contact.force);
  }
  return wrench;
}

double Square(const std::vector<LinkContact>& contacts) {
  double sum = 0;
  for (const LinkContact& contact : contacts) sum += contact.force.squaredNorm();
  return sum;
}

double Excess(const std::vector<LinkContact>& contacts, double friction) {
  double worst = -kInfinity;
  for (const LinkContact& contact : contacts) {
    worst = std::max(worst, contact.force.head<2>().norm() - friction * contact.force.z());
  }
  return worst;
}

// Random contacts of a foot on nearly flat ground; forces in the cone, but for an internal force.
std::vector<LinkContact> Foot(int count, double friction, bool planar, SeededRandom* random) {
  std::vector<LinkContact> contacts(count);
  for (LinkContact& contact : contacts) {
    contact.point = Vector3(random->Uniform(-0.1, 0.2), random->Uniform(-0.05, 0.05), random->Uniform(-1e-4, 1e-4));
    contact.along_y = !planar;
    const double normal = random->Uniform(50, 500), angle = random->Uniform(-3, 3);
    const double tangent = friction * normal * random->Uniform(0, 0.98);
    contact.force = Vector3(tangent * std::cos(angle), planar ? 0 : tangent * std::sin(angle), normal);
  }
  return contacts;
}
void AddInternal(double size, LinkContact* first, LinkContact* second) {
  Vector3 d = (first->point - second->point).normalized();
  if (!first->along_y) d.y() = 0;
  first->force += size * d;
  second->force -= size * d;
}

TEST(LeastRatioShift, AgreesWithASearch) {
  SeededRandom random(1);
  int bottoms = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector2d t_1(random.Uniform(-300, 300), random.Uniform(-100, 100));
    const Vector2d t_2(random.Uniform(-300, 300), random.Uniform(-100, 100));
    const double n_1 = random.Uniform(1, 500), n_2 = trial % 5 == 0 ? n_1 : random.Uniform(1, 500);
    const Vector2d d(random.Uniform(-1, 1), random.Uniform(-1, 1));
    const auto ratio = [&](double s) { return std::max((t_1 + s * d).norm() / n_1, (t_2 - s * d).norm() / n_2); };
    const double s = LeastRatioShift(t_1, n_1, t_2, n_2, d);
    // The larger of two convex functions: a ternary search closes in on its minimum.
    double low = -1e4 / d.norm(), high = 1e4 / d.norm();
    for (int i = 0; i < 200; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (ratio(a) < ratio(b) ? high : low) = ratio(a) < ratio(b) ? b : a;
    }
    EXPECT_LE(ratio(s), ratio(0.5 * (low + high)) * (1 + 1e-9)) << trial;
    bottoms += std::abs((t_1 + s * d).norm() / n_1 - (t_2 - s * d).norm() / n_2) > 1e-9;
  }
  EXPECT_GT(bottoms, 50);  // both cases occur: the bottom of one, and where they cross
  EXPECT_LT(bottoms, 2950);
}

class AdmissiblePair : public ::testing::TestWithParam<bool> {};

TEST_P(AdmissiblePair, IsTheLeastOfAllAdmissibleOnesWithTheSameWrench) {
  SeededRandom random(2);
  const double friction = 0.6;
  int at_the_cone = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<LinkContact> contacts = Foot(2, friction, GetParam(), &random);
    AddInternal(random.Uniform(-2000, 2000), &contacts[0], &contacts[1]);
    const std::vector<LinkContact> given = contacts;
    ASSERT_TRUE(AdmissibleForces(friction, contacts)) << trial;
    EXPECT_LT(Excess(contacts, friction), 1e-9) << trial;
    Vector6 change = Wrench(contacts) - Wrench(given);
    if (GetParam()) change[3] = change[5] = 0;  // a mechanism in the plane y = 0 sees neither
    EXPECT_LT(change.norm(), 1e-9) << trial;
    at_the_cone += Excess(contacts, friction) > -1e-9;
    // A little more or less of the internal force is longer, or not admissible.
    for (double step : {-1e-3, 1e-3}) {
      std::vector<LinkContact> other = contacts;
      AddInternal(step, &other[0], &other[1]);
      EXPECT_TRUE(Square(other) > Square(contacts) || Excess(other, friction) > 1e-12) << trial;
    }
    // What is given does not matter but for its wrench.
    std::vector<LinkContact> again = given;
    AddInternal(321, &again[0], &again[1]);
    ASSERT_TRUE(AdmissibleForces(friction, again));
    for (int c = 0; c < 2; ++c) EXPECT_LT((again[c].force - contacts[c].force).norm(), 1e-9) << trial;
  }
  EXPECT_GT(at_the_cone, 20);
  EXPECT_LT(at_the_cone, 480);
}

INSTANTIATE_TEST_SUITE_P(PlaneAndSpace, AdmissiblePair, ::testing::Bool());

TEST(AdmissibleForces, WhereNoneIsTheRatioIsLeast) {
  std::vector<LinkContact> contacts(2);
  contacts[0] = {Vector3(0.2, 0, 0), Vector3(900, 0, 300)};
  contacts[1] = {Vector3(0, 0, 0), Vector3(-200, 0, 400)};
  // 700 N along x over 700 N: no distribution has less than 1.
  EXPECT_FALSE(AdmissibleForces(0.9, contacts));
  EXPECT_NEAR(contacts[0].force.x() / 300, 1, 1e-12);
  EXPECT_NEAR(contacts[1].force.x() / 400, 1, 1e-12);
  EXPECT_TRUE(AdmissibleForces(1 + 1e-9, contacts));
  // Pulling contacts stay as they are.
  contacts[0].force = Vector3(10, 0, -5);
  EXPECT_FALSE(AdmissibleForces(0.9, contacts));
  EXPECT_EQ(contacts[0].force, Vector3(10, 0, -5));
}

TEST(AdmissibleForces, OneContactIsWhatItIs) {
  std::vector<LinkContact> contacts(1);
  contacts[0] = {Vector3::Zero(), Vector3(3, 4, 10)};
  EXPECT_TRUE(AdmissibleForces(0.5, contacts));
  EXPECT_FALSE(AdmissibleForces(0.49, contacts));
  EXPECT_EQ(contacts[0].force, Vector3(3, 4, 10));
  EXPECT_TRUE(AdmissibleForces(0.5, std::span<LinkContact>()));
}

TEST(AdmissibleForces, ALineThatOneContactDoesNotTransmitCarriesNothing) {
  std::vector<LinkContact> contacts(2);
  contacts[0] = {Vector3(0.2, 0, 0), Vector3(90, 0, 100)};
  contacts[1] = {Vector3(0, 0, 0), Vector3(0, 5, 400), false, true};
  const std::vector<LinkContact> given = contacts;
  EXPECT_TRUE(AdmissibleForces(0.95, contacts));
  EXPECT_EQ(contacts[0].force, given[0].force);
  EXPECT_FALSE(AdmissibleForces(0.85, contacts));
  EXPECT_EQ(contacts[1].force, given[1].force);
}

// The second algorithm: Dykstra's alternating projections of the origin on the wrench's subspace and on the cones.
std::vector<Vector3> Dykstra(double friction, const std::vector<LinkContact>& contacts) {
  const int n = static_cast<int>(contacts.size());
  MatrixX map = MatrixX::Zero(6, 3 * n);
  for (int c = 0; c < n; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      map.block<3, 1>(0, 3 * c + axis) = Vector3::Unit(axis);
      map.block<3, 1>(3, 3 * c + axis) = 10 * contacts[c].point.cross(Vector3::Unit(axis));
    }
  }
  Vector6 target = Wrench(contacts);
  target.tail<3>() *= 10;
  const MatrixX back = map.completeOrthogonalDecomposition().pseudoInverse();
  VectorX f = VectorX::Zero(3 * n), cone_part = VectorX::Zero(3 * n);
  for (int i = 0; i < 60000; ++i) {
    f += back * (target - map * f);  // a subspace needs no correction
    const VectorX shifted = f + cone_part;
    for (int c = 0; c < n; ++c) {
      Vector3 z = shifted.segment<3>(3 * c);
      const double r = z.head<2>().norm();
      if (r > friction * z.z()) {
        const double along = std::max(0.0, (z.z() + friction * r) / (1 + friction * friction));
        z << friction * along * z.head<2>() / r, along;
      }
      f.segment<3>(3 * c) = z;
    }
    cone_part = shifted - f;
  }
  std::vector<Vector3> result;
  for (int c = 0; c < n; ++c) result.push_back(f.segment<3>(3 * c));
  return result;
}

TEST(AdmissibleForces, MoreContactsAgreeWithAlternatingProjections) {
  SeededRandom random(5);
  const double friction = 0.5;
  for (int trial = 0; trial < 24; ++trial) {
    const int n = 3 + trial % 3;
    std::vector<LinkContact> contacts = Foot(n, 0.8 * friction, false, &random);
    AddInternal(random.Uniform(-1500, 1500), &contacts[0], &contacts[1]);
    AddInternal(random.Uniform(-1500, 1500), &contacts[1], &contacts[2]);
    const Vector6 wrench = Wrench(contacts);
    const std::vector<Vector3> expected = Dykstra(friction, contacts);
    ASSERT_TRUE(AdmissibleForces(friction, contacts)) << trial;
    EXPECT_LT((Wrench(contacts) - wrench).norm(), 1e-5) << trial;
    EXPECT_LT(Excess(contacts, friction), 1e-9) << trial;
    for (int c = 0; c < n; ++c) EXPECT_LT((contacts[c].force - expected[c]).norm(), 1e-2) << trial;
  }
}

TEST(AdmissibleForces, MoreContactsInThePlaneAndNoneThatIsAdmissible) {
  SeededRandom random(6);
  std::vector<LinkContact> contacts = Foot(3, 0.4, true, &random);
  AddInternal(800, &contacts[0], &contacts[2]);
  const Vector6 wrench = Wrench(contacts);
  ASSERT_TRUE(AdmissibleForces(0.5, contacts));
  EXPECT_LT(Excess(contacts, 0.5), 1e-9);
  for (int row : {0, 2, 4}) EXPECT_NEAR(Wrench(contacts)[row], wrench[row], 1e-6);
  for (const LinkContact& contact : contacts) EXPECT_EQ(contact.force.y(), 0);
  // Pushed sideways by more than friction can hold.
  contacts[1].force.x() += 5000;
  const Vector3 given = contacts[1].force;
  EXPECT_FALSE(AdmissibleForces(0.5, contacts));
  EXPECT_EQ(contacts[1].force, given);
}

}  // namespace
}  // namespace rollgait
