// The shape of a surface of a Model message.
#ifndef ROLLGAIT_CLIENT_REPORT_SURFACE_SHAPE_H_
#define ROLLGAIT_CLIENT_REPORT_SURFACE_SHAPE_H_

#include <Eigen/Core>
#include <optional>

#include "rollgait/v1/surface.pb.h"

namespace rollgait::client {

// The support function of a superellipsoid with smoothing, as rollgait.v1.Superellipsoid defines it, divided by the
// semi-axes: the body itself is this one stretched by them.
struct SmoothShape {
  double q_1, q_2;   // dual exponents, along z and around z
  double smoothing;  // σ
  // The point of the body furthest along a direction of any length.
  Eigen::Vector3d FurthestPoint(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Vector3d Gradient(const Eigen::Vector3d& t) const;
};

struct SurfaceShape {
  Eigen::Vector3d semi_axes;         // m
  std::optional<SmoothShape> super;  // without it the surface is drawn as an ellipsoid
  // m, in the axes of the surface: its point furthest along a direction.
  Eigen::Vector3d FurthestPoint(const Eigen::Vector3d& direction) const;
};

// A sphere is an ellipsoid of equal axes. A superellipsoid without smoothing, of scenes only, is drawn as the ellipsoid
// of its semi-axes. Throws Failure(kUsage) for a surface without a shape that this client knows.
SurfaceShape ShapeOf(const v1::Surface& surface);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_SURFACE_SHAPE_H_
