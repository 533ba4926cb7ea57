#ifndef ROLLGAIT_TESTS_SUPPORT_EXTREME_CONTACTS_H_
#define ROLLGAIT_TESTS_SUPPORT_EXTREME_CONTACTS_H_

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/contact/contact_pair.h"
#include "tests/support/seeded_random.h"

namespace rollgait {

// Random bodies and motions over the whole range the library promises: axis ratios 1e-3 … 1e3, sizes 1e-3 … 1e3 m,
// spins up to 1e3 rad/s, exponents 0.05 … 1.95, near-spheres, principal axes exactly along the normal and 1e-14 off it.
class ExtremeContacts {
 public:
  explicit ExtremeContacts(unsigned seed) : random_(seed) {}

  SeededRandom& random() { return random_; }

  Vector3 Axes() {
    const double size = random_.LogUniform(1e-3, 1e3);
    switch (Choice(4)) {
      case 0:  // near-sphere
        return size * (Vector3::Ones() + Scaled(random_.Vector(-1, 1), 1e-15, 1e-3));
      case 1: {  // a foot, a stone
        const double z = random_.Uniform(0.2, 1), y = random_.Uniform(0.2, 1);
        return size * Vector3(1, y, z);
      }
      default: {
        const double z = random_.LogUniform(1e-3, 1), x = random_.LogUniform(1e-3, 1);
        return size * Vector3(x, 1, z);
      }
    }
  }
  Surface AnySurface() {
    switch (Choice(6)) {
      case 0:
        return Sphere(random_.LogUniform(1e-3, 1e3));
      case 1:
        return AnySuperellipsoid();
      case 2:
        return AnySuperellipsoid().Rounded(random_.LogUniform(1e-3, 1));
      default:
        return Ellipsoid(Axes());
    }
  }
  Matrix3 Rotation() {
    Matrix3 R = Matrix3::Zero();
    const int shift = Choice(3);
    for (int i = 0; i < 3; ++i) R(i, (i + shift) % 3) = 1;  // exactly aligned
    switch (Choice(4)) {
      case 0:
        return R;
      case 1:
        return Turn(Scaled(random_.Unit(), 1e-14, 1e-2)) * R;
      default: {
        const Vector3 axis = random_.Unit();
        return Turn(random_.Uniform(0, 3.1) * axis);
      }
    }
  }
  // The vector times a factor, which is drawn after it: a product of two draws would leave their order to the compiler.
  Vector3 Scaled(const Vector3& vector, double min, double max) { return random_.LogUniform(min, max) * vector; }
  // At rest at the origin of its accelerations: only what moves is drawn here.
  FrameMotion Motion(double length) {
    FrameMotion body;
    body.R_WB = Rotation();
    body.p_WB = length * random_.Vector(-2, 2);
    const double rate = random_.LogUniform(1e-2, 1e3);
    body.w_WB = rate * random_.Unit();
    body.v_WB = rate * length * random_.Vector(-1, 1);
    body.alpha_WB = rate * rate * random_.Vector(-1, 1);
    body.a_WB = rate * rate * length * random_.Vector(-1, 1);
    return body;
  }
  int Choice(int count) { return std::min(count - 1, static_cast<int>(random_.Uniform(0, count))); }

  static Matrix3 Turn(const Vector3& theta) {
    const double angle = theta.norm();
    return angle == 0 ? Matrix3::Identity() : Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix();
  }

 private:
  Surface AnySuperellipsoid() {
    const double e2 = Exponent(), e1 = Exponent();
    return Superellipsoid(Axes(), e1, e2);
  }
  double Exponent() {
    const double special[] = {0.05, 0.5, 1, 1.5, 1.95};
    return Choice(3) == 0 ? special[Choice(5)] : random_.Uniform(0.05, 1.95);
  }

  SeededRandom random_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_EXTREME_CONTACTS_H_
