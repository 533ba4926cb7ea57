// The rows of friction against the cone itself: in the plane they are it, in space a pyramid within it whose edges
// touch it, whatever edges it has.
#include "core/ocp/constraints/friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace rollgait {
namespace {

constexpr double kMu = 0.4;
constexpr double kDegree = std::numbers::pi / 180;

class FrictionTest : public ::testing::Test {
 protected:
  FrictionTest() : contacts_(2) {
    contacts_[0].name = "heel";
    contacts_[1].name = "forefoot";
    contacts_[1].joint = 1;
  }
  // Values of the rows of one contact, with the edges `added`, at this force.
  std::vector<double> At(const Vector3& force, const std::vector<FrictionEdge>& added = {}) const {
    std::vector<double> values;
    for (const ForceRow& row : FrictionRows(contacts_, {{0, 0, {0, 1, 2}}}, kMu, added)) {
      values.push_back(0);
      for (const auto& [offset, coefficient] : row.terms) values.back() += coefficient * force(offset);
    }
    return values;
  }
  static double Least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }
  static Vector3 OnTheCone(double degrees, double normal) {
    return {kMu * normal * std::cos(degrees * kDegree), kMu * normal * std::sin(degrees * kDegree), normal};
  }

  std::vector<ContactSurface> contacts_;
  const std::vector<std::vector<FrictionEdge>> edge_sets_ = {
      {}, {{0, 2}, {0, 20}, {0, 71}}, {{0, 0}, {0, 19}, {1, 3}}, {{0, 17}, {0, 40}, {0, 41}, {0, 42}}};
};

TEST_F(FrictionTest, IsTheConeInThePlane) {
  for (ContactSurface& contact : contacts_) contact.directions = {0, 2};
  const std::vector<ForceRow> rows = FrictionRows(contacts_, {{0, 0, {0, 2}}, {1, 2, {0, 2}}}, 0.5, {{0, 3}});
  PointLayout layout;
  layout.forces = 4;
  FrictionConstraint plane(rows, layout, 1);
  ASSERT_EQ(plane.rows(), 4);
  double g[4];
  VectorX z(4);
  z << 30, 100, 5, 40;
  plane.Value({z.data()}, g);
  EXPECT_NEAR(g[0], 80, 1e-12);
  EXPECT_NEAR(g[1], 20, 1e-12);
  EXPECT_NEAR(g[2], 25, 1e-12);
  EXPECT_NEAR(g[3], 15, 1e-12);
  for (int r = 0; r < 4; ++r) {
    EXPECT_EQ(rows[r].independent, r % 2 == 0);
    EXPECT_FALSE(rows[r].shared);
  }
}

TEST_F(FrictionTest, ASurfaceWithoutTangentialDirectionsHasNoRows) {
  EXPECT_TRUE(FrictionRows(contacts_, {{0, 0, {2}}}, kMu).empty());
}

// Whatever force the rows admit is in the cone.
TEST_F(FrictionTest, PyramidsLieWithinTheCone) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const auto& added : edge_sets_) {
    int admitted = 0;
    for (int trial = 0; trial < 20000; ++trial) {
      const double x = kMu * number(random), y = kMu * number(random), z = number(random);
      const Vector3 force(x, y, z);
      if (Least(At(force, added)) < 0) continue;
      ++admitted;
      EXPECT_LE(force.head<2>().norm(), kMu * force.z() + 1e-15);
    }
    EXPECT_GT(admitted, 500);
  }
}

// A force on the cone in the direction of an edge is admitted, on the two sides that meet there, and a little more is
// not; in any other direction the cone is outside.
TEST_F(FrictionTest, EdgesTouchTheCone) {
  for (const auto& added : edge_sets_) {
    for (int direction = 0; direction < 72; ++direction) {
      const double degrees = 5.0 * direction;
      bool is_edge = direction % 9 == 0;
      for (const FrictionEdge& edge : added) is_edge |= edge.contact == 0 && edge.direction == direction;
      std::vector<double> values = At(OnTheCone(degrees, 50), added);
      EXPECT_EQ(Least(values) > -1e-12, is_edge) << degrees;
      if (is_edge) {
        EXPECT_EQ(std::count_if(values.begin(), values.end(), [](double value) { return value < 1e-12; }), 2);
        Vector3 beyond = OnTheCone(degrees, 50);
        beyond.head<2>() *= 1 + 1e-9;
        EXPECT_LT(Least(At(beyond, added)), -1e-12) << degrees;
      }
    }
  }
}

// In the middle of a side of 45° the pyramid admits cos 22.5° of the cone, where an edge is added all of it.
TEST_F(FrictionTest, SidesAreAsFarFromTheConeAsTheirWidthSays) {
  Vector3 force = OnTheCone(22.5, 50);
  force.head<2>() *= std::cos(22.5 * kDegree);
  EXPECT_NEAR(Least(At(force)), 0, 1e-12);
  ASSERT_EQ(At(force).size(), 8u);
  ASSERT_EQ(At(force, {{0, 4}}).size(), 9u);
  // Between 20° and 45° it is cos 12.5°, in the middle of them.
  force = OnTheCone(32.5, 50);
  force.head<2>() *= std::cos(12.5 * kDegree);
  EXPECT_NEAR(Least(At(force, {{0, 4}})), 0, 1e-12);
  EXPECT_EQ(FrictionDirections(0, {{0, 4}, {0, 9}, {1, 7}}), (std::vector<int>{0, 4, 9, 18, 27, 36, 45, 54, 63}));
}

// With no normal force the independent rows are two equations in the two tangential forces, well apart; where a link
// shares its force along x, the row that is not shared determines the force along y.
TEST_F(FrictionTest, IndependentRowsDetermineTheTangentialForces) {
  for (const int joint : {1, 0}) {
    contacts_[1].joint = joint;
    for (const auto& added : edge_sets_) {
      const auto rows = FrictionRows(contacts_, {{0, 0, {0, 1, 2}}, {1, 3, {0, 1, 2}}}, kMu, added);
      for (int contact = 0; contact < 2; ++contact) {
        std::vector<Eigen::Vector2d> shared, others;
        for (const ForceRow& row : rows) {
          if (row.contact != contact) continue;
          ASSERT_EQ(row.terms.size(), 3u);
          if (row.independent) {
            (row.shared ? shared : others).emplace_back(row.terms[1].second, row.terms[2].second);
            EXPECT_EQ(row.terms[1].first, 3 * contact);
            EXPECT_EQ(row.terms[2].first, 3 * contact + 1);
          } else {
            EXPECT_FALSE(row.shared);
          }
        }
        ASSERT_EQ(shared.size(), joint == 0 ? 1u : 0u);
        ASSERT_EQ(shared.size() + others.size(), 2u);
        const Eigen::Vector2d along = joint == 0 ? shared[0] : others[0], across = others.back();
        EXPECT_GT(std::abs(along.x() * across.y() - along.y() * across.x()), std::sin(67 * kDegree));
        EXPECT_GT(std::abs(across.y()), std::cos(23 * kDegree));
      }
    }
  }
}

// The pattern names exactly the entries that differ from zero, and these are the differences of the values.
TEST_F(FrictionTest, DerivativesAreThoseOfTheValues) {
  PointLayout layout;
  layout.n = 2;
  layout.efforts = 1;
  layout.forces = 6;
  for (const auto& added : edge_sets_) {
    FrictionConstraint friction(FrictionRows(contacts_, {{0, 0, {0, 1, 2}}, {1, 3, {0, 1, 2}}}, kMu, added), layout, 1);
    MatrixX jacobian = MatrixX::Zero(friction.rows(), layout.size()), pattern = jacobian;
    for (const auto& [row, column] : friction.JacobianPattern()) pattern(row, column) = 1;
    VectorX z = VectorX::LinSpaced(layout.size(), -3, 8), before(friction.rows()), after(friction.rows());
    friction.Jacobian({z.data()}, jacobian);
    friction.Value({z.data()}, before.data());
    for (int column = 0; column < layout.size(); ++column) {
      VectorX moved = z;
      moved(column) += 1;  // the rows are linear
      friction.Value({moved.data()}, after.data());
      for (int row = 0; row < friction.rows(); ++row) {
        EXPECT_NEAR(jacobian(row, column), after(row) - before(row), 1e-13);
        EXPECT_EQ(std::abs(after(row) - before(row)) > 1e-9, pattern(row, column) == 1) << row << " " << column;
      }
    }
  }
}

}  // namespace
}  // namespace rollgait
