#include "tests/conformance/surface_cases.h"

#include <cmath>
#include <memory>

#include "core/geometry/flattened_superellipsoid.h"

namespace rollgait {
namespace {

double Barr(const Vector3& x, const Vector3& axes, double eps1, double eps2) {
  const Vector3 t = x.cwiseQuotient(axes).cwiseAbs();
  const double around = std::pow(t.x(), 2 / eps2) + std::pow(t.y(), 2 / eps2);
  return std::pow(around, eps2 / eps1) + std::pow(t.z(), 2 / eps1) - 1;
}

// (x/a)⁴ + (y/b)² + (z/c)² + x²y²/(a²b²)/4 + x/(4a) − 1: not symmetric about the origin, no norm, no quadric.
class Quartic : public ConvexFunction {
 public:
  explicit Quartic(double scale) : axes_(scale * Vector3(1.3, 0.7, 0.9)) {}
  double Value(const Vector3& p) const override {
    const Vector3 t = p.cwiseQuotient(axes_);
    const double x = t.x(), y = t.y(), z = t.z();
    return x * x * x * x + 0.5 * x * x + y * y + z * z + x * x * y * y / 4 + x / 4 - 1;
  }
  Vector3 Gradient(const Vector3& p) const override {
    const Vector3 t = p.cwiseQuotient(axes_);
    const double x = t.x(), y = t.y(), z = t.z();
    return Vector3(4 * x * x * x + x + x * y * y / 2 + 0.25, 2 * y + x * x * y / 2, 2 * z).cwiseQuotient(axes_);
  }
  Matrix3 Hessian(const Vector3& p) const override {
    const Vector3 t = p.cwiseQuotient(axes_);
    const double x = t.x(), y = t.y();
    Matrix3 hessian = Matrix3::Zero();
    hessian(0, 0) = 12 * x * x + 1 + y * y / 2;
    hessian(1, 1) = 2 + x * x / 2;
    hessian(2, 2) = 2;
    hessian(0, 1) = hessian(1, 0) = x * y;
    return Scaled(hessian);
  }
  Matrix3 Third(const Vector3& p, const Vector3& direction) const override {
    const Vector3 t = p.cwiseQuotient(axes_), u = direction.cwiseQuotient(axes_);
    const double x = t.x(), y = t.y();
    Matrix3 third = Matrix3::Zero();
    third(0, 0) = 24 * x * u.x() + y * u.y();
    third(1, 1) = x * u.x();
    third(0, 1) = third(1, 0) = y * u.x() + x * u.y();
    return Scaled(third);
  }
  Matrix3 Fourth(const Vector3&, const Vector3& direction, const Vector3& other) const override {
    const Vector3 u = direction.cwiseQuotient(axes_), w = other.cwiseQuotient(axes_);
    Matrix3 fourth = Matrix3::Zero();
    fourth(0, 0) = 24 * u.x() * w.x() + u.y() * w.y();
    fourth(1, 1) = u.x() * w.x();
    fourth(0, 1) = fourth(1, 0) = u.x() * w.y() + u.y() * w.x();
    return Scaled(fourth);
  }
  int derivatives() const override { return 4; }

 private:
  Matrix3 Scaled(const Matrix3& matrix) const {
    const Vector3 inverse = axes_.cwiseInverse();
    return inverse.asDiagonal() * matrix * inverse.asDiagonal();
  }
  Vector3 axes_;
};

SurfaceCase SuperellipsoidCase(const std::string& name, const Vector3& axes, double eps1, double eps2, double angle) {
  return {name, [=](double scale) { return Surface(Superellipsoid::Create(scale * axes, eps1, eps2).value()); },
          [=](const Vector3& x) { return Barr(x, axes, eps1, eps2); }, 0.3, angle};
}

// Normals of any direction: no flats, edges or tips.
SurfaceCase SmoothCase(const std::string& name, double eps1, double eps2, double angle) {
  const Vector3 axes(0.8, 1.2, 0.5);
  return {name,
          [=](double scale) { return Surface(SmoothSuperellipsoid::Create(scale * axes, eps1, eps2, 0.2).value()); },
          nullptr, 0, angle};
}

SurfaceCase CoveredCase(const std::string& name, const Vector3& axes, const Vector3& cover,
                        const std::function<double(const Vector3&)>& equation, double angle) {
  return {name, [=](double scale) { return Surface(CoveredEllipsoid::Create(scale * axes, scale * cover).value()); },
          equation, 0, angle};
}

SurfaceCase FlattenedCase(const std::string& name, double eps1, double eps2, double delta, double angle) {
  const Vector3 axes(0.8, 1.2, 0.5);
  return {
      name,
      [=](double scale) { return Surface(FlattenedSuperellipsoid::Create(scale * axes, eps1, eps2, delta).value()); },
      [=](const Vector3& x) {
        return (Barr(x, axes, eps1, eps2) + 1 + delta * x.cwiseQuotient(axes).squaredNorm()) / (1 + delta) - 1;
      },
      0.3, angle};
}

std::vector<SurfaceCase> MakeCases() {
  const Vector3 axes(0.8, 1.2, 0.5);
  const auto ellipsoid = [=](const Vector3& x) { return x.cwiseQuotient(axes).squaredNorm() - 1; };
  const Vector3 center(0.3, -0.2, 0.7);
  return {
      {"Ellipsoid", [=](double scale) { return Surface(Ellipsoid(scale * axes)); }, ellipsoid, 0, 0.4},
      {"Sphere", [](double scale) { return Surface(Sphere(scale * 0.7)); },
       [](const Vector3& x) { return x.squaredNorm() - 0.49; }, 0, 1},
      {"MovedEllipsoid", [=](double scale) { return Surface(Ellipsoid(scale * axes)).MovedTo(scale * center); },
       [=](const Vector3& x) { return ellipsoid(x - center); }, 0, 0.4},
      {"RoundedEllipsoid", [=](double scale) { return Surface(Ellipsoid(scale * axes)).Rounded(scale * 0.2); }, nullptr,
       0, 0.4},
      SuperellipsoidCase("SuperellipsoidIsEllipsoid", axes, 1, 1, 0.4),
      SuperellipsoidCase("BoxySuperellipsoid", axes, 0.5, 0.7, 0.3),
      SuperellipsoidCase("PinchedSuperellipsoid", axes, 1.4, 1.2, 0.3),
      SuperellipsoidCase("MixedSuperellipsoid", axes, 0.6, 1.3, 0.3),
      SuperellipsoidCase("VeryBoxySuperellipsoid", axes, 0.1, 0.2, 0.25),
      SuperellipsoidCase("VeryPinchedSuperellipsoid", axes, 1.7, 1.6, 0.1),
      {"RoundedPinchedSuperellipsoid",
       [=](double scale) {
         return Surface(Superellipsoid::Create(scale * axes, 1.4, 1.2).value()).Rounded(scale * 0.1);
       },
       nullptr, 0.3, 0.3},
      SmoothCase("SmoothBoxySuperellipsoid", 0.6, 0.6, 0.15),
      SmoothCase("SmoothPinchedSuperellipsoid", 1.6, 1.6, 0.1),
      SmoothCase("SmoothMixedSuperellipsoid", 0.7, 1.4, 0.15),
      CoveredCase("CoveredEllipsoid", axes, {0.3, 0.9, 0.1}, nullptr, 0.1),
      CoveredCase("EvenlyCoveredEllipsoid", axes, {0.2, 0.2, 0.2}, nullptr, 0.3),
      CoveredCase("ThinCoreInACover", axes, {0.05, 0.1, 0.47}, nullptr, 0.025),
      CoveredCase("EllipsoidWithoutCover", axes, {0, 0, 0}, ellipsoid, 0.4),
      CoveredCase("EllipsoidInACoverOfItsShape", axes, 0.3 * axes, ellipsoid, 0.4),
      CoveredCase(
          "SphereInASphere", {0.7, 0.7, 0.7}, {0.3, 0.3, 0.3}, [](const Vector3& x) { return x.squaredNorm() - 0.49; },
          1),
      FlattenedCase("FlattenedSuperellipsoid", 0.5, 0.8, 0.05, 0.2),
      FlattenedCase("FlattenedBox", 0.25, 0.25, 0.02, 0.12),
      {"ImplicitQuartic",
       [](double scale) { return Surface(ImplicitSurface::Create(std::make_shared<Quartic>(scale)).value()); },
       [](const Vector3& x) { return Quartic(1).Value(x); }, 0, 0.25},
  };
}

}  // namespace

const std::vector<SurfaceCase>& SurfaceCases() {
  static const std::vector<SurfaceCase> cases = MakeCases();
  return cases;
}

}  // namespace rollgait
