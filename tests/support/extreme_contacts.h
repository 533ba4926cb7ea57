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
        return size * (Vector3::Ones() + random_.LogUniform(1e-15, 1e-3) * random_.Vector(-1, 1));
      case 1:  // a foot, a stone
        return size * Vector3(1, random_.Uniform(0.2, 1), random_.Uniform(0.2, 1));
      default:
        return size * Vector3(random_.LogUniform(1e-3, 1), 1, random_.LogUniform(1e-3, 1));
    }
  }
  Surface AnySurface() {
    switch (Choice(6)) {
      case 0:
        return Sphere(random_.LogUniform(1e-3, 1e3));
      case 1:
        return Superellipsoid(Axes(), Exponent(), Exponent());
      case 2:
        return Surface(Superellipsoid(Axes(), Exponent(), Exponent())).Rounded(random_.LogUniform(1e-3, 1));
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
        return Turn(random_.LogUniform(1e-14, 1e-2) * random_.Unit()) * R;
      default:
        return Turn(random_.Uniform(0, 3.1) * random_.Unit());
    }
  }
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
  double Exponent() {
    const double special[] = {0.05, 0.5, 1, 1.5, 1.95};
    return Choice(3) == 0 ? special[Choice(5)] : random_.Uniform(0.05, 1.95);
  }

  SeededRandom random_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_EXTREME_CONTACTS_H_
