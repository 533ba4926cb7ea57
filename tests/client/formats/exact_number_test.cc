#include "client/formats/exact_number.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

namespace rollgait::client {
namespace {

TEST(ExactNumberTest, ReadsBackAsTheSameDouble) {
  for (const double value : {0.1, 1.0 / 3, 1e-300, -123456.789, 5e-324, 1.7976931348623157e308}) {
    EXPECT_EQ(std::strtod(Exact(value).c_str(), nullptr), value) << Exact(value);
  }
  EXPECT_EQ(Exact(0.1), "0.1");
  EXPECT_EQ(Exact(-0.0), "0");
  EXPECT_EQ(Exact(INFINITY), "inf");
  EXPECT_EQ(Exact(-INFINITY), "-inf");
  EXPECT_EQ(Exact(NAN), "nan");
}

TEST(ExactNumberTest, QuaternionOfARotation) {
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(-2.5, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  std::istringstream text(ExactQuaternion(turned));
  double w = 0, x = 0, y = 0, z = 0;
  text >> w >> x >> y >> z;
  EXPECT_GE(w, 0);
  EXPECT_LT((Eigen::Quaterniond(w, x, y, z).toRotationMatrix() - turned).norm(), 1e-15);
}

}  // namespace
}  // namespace rollgait::client
