#include "client/report/surface_shape.h"

#include <cmath>

#include "client/failure.h"
#include "client/report/kinematics.h"

namespace rollgait::client {

using Eigen::Vector3d;

// With n_i = √(t_i² + σ²‖t‖²) and m = (n₁^q₂ + n₂^q₂)^(1/q₂), of h = (m^q₁ + n₃^q₁)^(1/q₁).
Vector3d SmoothShape::Gradient(const Vector3d& t) const {
  const double round = smoothing * smoothing;
  const Vector3d n = (t.array().square() + round * t.squaredNorm()).sqrt();
  const double m = std::pow(std::pow(n.x(), q_2) + std::pow(n.y(), q_2), 1 / q_2);
  const double h = std::pow(std::pow(m, q_1) + std::pow(n.z(), q_1), 1 / q_1);
  const double by_m = std::pow(m / h, q_1 - 1);
  const Vector3d by_n(by_m * std::pow(n.x() / m, q_2 - 1), by_m * std::pow(n.y() / m, q_2 - 1),
                      std::pow(n.z() / h, q_1 - 1));
  const Vector3d slopes = by_n.cwiseQuotient(n);  // ∂n_i/∂t_j = (δ_ij + σ²) t_j / n_i
  return (slopes.array() + round * slopes.sum()).matrix().cwiseProduct(t);
}

Vector3d SmoothShape::FurthestPoint(const Vector3d& direction) const {
  Vector3d scales;  // make the semi-axes 1
  for (int i = 0; i < 3; ++i) scales[i] = 1 / Gradient(Vector3d::Unit(i))[i];
  return scales.cwiseProduct(Gradient(scales.cwiseProduct(direction)));
}

Vector3d SurfaceShape::FurthestPoint(const Vector3d& direction) const {
  const Vector3d stretched = semi_axes.cwiseProduct(direction);
  return semi_axes.cwiseProduct(super ? super->FurthestPoint(stretched) : Vector3d(stretched.normalized()));
}

SurfaceShape ShapeOf(const v1::Surface& surface) {
  switch (surface.shape_case()) {
    case v1::Surface::kEllipsoid:
      return {ToVector(surface.ellipsoid().semi_axes_m()), {}};
    case v1::Surface::kSuperellipsoid: {
      const v1::Superellipsoid& shape = surface.superellipsoid();
      if (shape.smoothing() == 0) return {ToVector(shape.semi_axes_m()), {}};
      return {ToVector(shape.semi_axes_m()),
              SmoothShape{2 / (2 - shape.exponent_1()), 2 / (2 - shape.exponent_2()), shape.smoothing()}};
    }
    case v1::Surface::kSphere:
      return {Vector3d::Constant(surface.sphere().radius_m()), {}};
    default:
      throw Failure(ExitCode::kUsage, "a surface of the model has no shape that this client knows");
  }
}

}  // namespace rollgait::client
