// The shape of a surface of a Model message.
#ifndef ROLLGAIT_CLIENT_REPORT_SURFACE_SHAPE_H_
#define ROLLGAIT_CLIENT_REPORT_SURFACE_SHAPE_H_

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/surface.pb.h"

namespace rollgait::client {

// The support function of a body as a norm of norms of a direction t: (Σ N_k(t)^q)^(1/q) of its `parts`, or, without
// parts, the length √(Σ s_i t_i²) with `squares` s. Any such tree is the support function of a convex body; the page of
// a report computes the same from ToJson (client/report/page/ellipses.js).
struct SupportNorm {
  double exponent = 2;  // q ≥ 1
  std::vector<SupportNorm> parts = {};
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();

  double Value(const Eigen::Vector3d& t) const;
  // By t: the point of the body furthest along t. Contract: no part is zero at t.
  Eigen::Vector3d Gradient(const Eigen::Vector3d& t) const;
  nlohmann::json ToJson() const;
};

struct SurfaceShape {
  Eigen::Vector3d semi_axes;        // m, half the box around the surface
  std::optional<SupportNorm> form;  // of the surface divided by the semi-axes; without it an ellipsoid
  std::string numbers;              // beside the semi-axes, to be read: "exponents 0.8, 0.8"
  // m, in the axes of the surface: its point furthest along a direction of any length.
  Eigen::Vector3d FurthestPoint(const Eigen::Vector3d& direction) const;
};

// A sphere is an ellipsoid of equal axes. A superellipsoid without smoothing, of scenes only, is drawn as the ellipsoid
// of its semi-axes. Throws Failure(kUsage) for a surface without a shape that this client knows.
SurfaceShape ShapeOf(const v1::Surface& surface);

// Whether bodies that walk may have such a surface (the server knows within which bounds), and which these are: "an
// ellipsoid or a superellipsoid", separated by commas where there are more.
bool MayWalk(const v1::Surface& surface);
std::string NamesOfWalkingShapes();

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_SURFACE_SHAPE_H_
