// Ellipsoid over a plane against 40-digit reference values (tests/data/ellipsoid_plane.json, which states the
// tolerances).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/geometry/ellipsoid.h"

namespace rollgait {
namespace {

using Json = nlohmann::json;
using Long = long double;
using LongVector3 = Eigen::Matrix<Long, 3, 1>;
using LongMatrix3 = Eigen::Matrix<Long, 3, 3>;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

LongVector3 Input(const Json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

LongVector3 Expected(const Json& strings) {
  LongVector3 vector;
  for (int i = 0; i < 3; ++i) vector(i) = std::stold(strings[i].get<std::string>());
  return vector;
}

LongMatrix3 ExpectedMatrix(const Json& rows) {
  LongMatrix3 matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = Expected(rows[i]).transpose();
  return matrix;
}

// One case. The rotation and the normal are made in long double, so that what is measured is the ellipsoid's own
// rounding and that of one vector.
void CheckCase(const Json& item) {
  const Json& expect = item["expect"];
  const Vector3 axes = Input(item["semi_axes"]).cast<double>();
  const Ellipsoid ellipsoid(axes);
  const Json& q = item["quat_wxyz"];
  const LongMatrix3 R =
      Eigen::Quaternion<Long>(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>())
          .normalized()
          .toRotationMatrix();
  const LongVector3 n = Input(item["plane_normal"]).normalized();
  const Vector3 nu = -(R.transpose() * n).cast<double>();

  const LongVector3 r = R * ellipsoid.SupportPoint(nu).cast<Long>();
  const LongVector3 r_expected = Expected(expect["r"]);
  const double ratio = axes.maxCoeff() / axes.minCoeff();
  EXPECT_LE((r - r_expected).norm(), 4 * kEpsilon * ratio * r_expected.norm());

  const LongMatrix3 S = R * ellipsoid.SupportHessian(nu).cast<Long>() * R.transpose();
  const LongMatrix3 S_expected = ExpectedMatrix(expect["S_world"]);
  EXPECT_LE((S - S_expected).norm(), 300 * kEpsilon * S_expected.norm());

  const LongVector3 omega = Input(item["omega"]) - Input(item["plane_omega"]);
  const LongVector3 x_rel = S * omega.cross(n);
  const LongVector3 x_rel_expected = Expected(expect["x_rel_world"]);
  EXPECT_LE((x_rel - x_rel_expected).norm(), 300 * kEpsilon * x_rel_expected.norm());

  const LongVector3 offset = Input(item["center"]) - Input(item["plane_point"]);
  const double gap = static_cast<double>(n.dot(offset)) - ellipsoid.Support(nu);
  const double gap_expected = std::stod(expect["gap"].get<std::string>());
  EXPECT_NEAR(gap, gap_expected, 10 * kEpsilon * static_cast<double>(offset.norm() + r_expected.norm()));
}

TEST(EllipsoidReferenceTest, AgreesWithFortyDigits) {
  std::ifstream file(ROLLGAIT_TEST_DATA "/ellipsoid_plane.json");
  ASSERT_TRUE(file.good());
  const Json reference = Json::parse(file);
  std::map<std::string, int> families;
  for (const Json& item : reference["cases"]) {
    SCOPED_TRACE(item["family"].get<std::string>() + " " + std::to_string(item["id"].get<int>()));
    CheckCase(item);
    ++families[item["family"].get<std::string>()];
  }
  EXPECT_EQ(families.size(), 10u);
  for (const auto& [family, count] : families) EXPECT_EQ(count, 4) << family;
}

}  // namespace
}  // namespace rollgait
