#ifndef ROLLGAIT_CORE_MODELS_FOOT_H_
#define ROLLGAIT_CORE_MODELS_FOOT_H_

#include <map>
#include <string>
#include <vector>

#include "core/contact/contact_surface.h"
#include "core/geometry/ellipsoid.h"
#include "core/models/segment_table.h"

namespace rollgait {

// A surface of a foot, axes forward, left and up when the foot is level; its lowest point is then at the sole.
struct FootSurface {
  std::string name;  // "foot", or "heel" and "forefoot"
  FootPart part;
  Ellipsoid surface;
  Vector3 center;        // m, from the ankle joint
  bool on_toes = false;  // rides on the toes, if they are a link of their own
};
// Semi-axes of surfaces by their names, m. The others follow from the lengths of foot and leg.
using FootAxes = std::map<std::string, Vector3>;
// Whatever the semi-axes: a whole foot stays in the middle between heel and toes, a heel ends at the heel, a forefoot
// at the tip of the toes. Names that the shape does not have mean nothing. Contract: each axis > 0.
std::vector<FootSurface> FootSurfaces(const SegmentTable& table, FootShape shape, const FootAxes& axes = {});

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
