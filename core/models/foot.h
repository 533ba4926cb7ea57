#ifndef ROLLGAIT_CORE_MODELS_FOOT_H_
#define ROLLGAIT_CORE_MODELS_FOOT_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/contact_surface.h"
#include "core/models/segment_table.h"

namespace rollgait {

// Exponents of feet that walk (docs/explanation/walking.md), and the smoothing of all of them: without it a foot would
// stand flat where a superellipsoid has no curvature, or no derivative of it.
inline constexpr double kLeastFootExponent = SmoothSuperellipsoid::kLeastWalkingExponent;
inline constexpr double kMostFootExponent = SmoothSuperellipsoid::kMostWalkingExponent;
inline constexpr double kFootSmoothing = SmoothSuperellipsoid::kLeastWalkingSmoothing;

// A surface of a foot, axes forward, left and up when the foot is level; its lowest point is then at the sole.
struct FootSurface {
  std::string name;  // "foot", or "heel" and "forefoot"
  FootPart part;
  Vector3 semi_axes;  // m
  Surface surface;
  Vector3 center;        // m, from the ankle joint
  bool on_toes = false;  // rides on the toes, if they are a link of their own
};
// What a request says of a surface. Semi-axes that it does not give follow from the lengths of foot and leg; without an
// exponent the surface is an ellipsoid, with one a superellipsoid of that exponent along and around its height.
struct FootOutline {
  std::optional<Vector3> semi_axes;  // m
  std::optional<double> exponent;    // [kLeastFootExponent, kMostFootExponent]
  bool operator==(const FootOutline&) const = default;
};
using FootOutlines = std::map<std::string, FootOutline>;  // by the names of surfaces
// Whatever the semi-axes: a whole foot stays in the middle between heel and toes, a heel ends at the heel, a forefoot
// at the tip of the toes. Names that the shape does not have mean nothing. Contract: each axis > 0.
std::vector<FootSurface> FootSurfaces(const SegmentTable& table, FootShape shape, const FootOutlines& outlines = {});

// The foot cut at the metatarsal heads. Together the two are the foot of the table.
struct FootBodies {
  RigidBody foot;  // from the ankle joint, without the toes
  RigidBody toes;  // from the toe joint (SegmentTable::AnkleToToes)
};
FootBodies SplitFoot(const SegmentTable& table, BodySide side);

// Where the numbers come from.
std::vector<std::string> FootSources();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_FOOT_H_
