#ifndef ROLLGAIT_CORE_CONTACT_CONTACT_SURFACE_H_
#define ROLLGAIT_CORE_CONTACT_CONTACT_SURFACE_H_

#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/multibody/joint_role.h"

namespace rollgait {

// Which part of a foot a surface is. A foot is one surface, or a heel and a toe (forefoot).
enum class FootPart { kNone, kWhole, kHeel, kToe };

// A surface of a model that may touch the fixed ground plane z = 0 (normal +z, world axes). See
// rollgait.v1.ContactSurface.
struct ContactSurface {
  std::string name;
  int joint = 0;  // whose link carries it
  Surface surface = Sphere(1);
  Vector3 p_LE = Vector3::Zero();      // m, origin of the surface in the link frame
  Matrix3 R_LE = Matrix3::Identity();  // surface axes -> link frame
  int mirror_contact = 0;              // index of the left/right mirror image
  // World axes (0 = x, 1 = y, 2 = z) in which force is transmitted and velocity forbidden; the normal z is always the
  // last. {0, 2} in the sagittal plane, {0, 1, 2} in space.
  std::vector<int> directions = {0, 1, 2};
  BodySide side = BodySide::kMidline;  // of the leg that it belongs to
  FootPart part = FootPart::kNone;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONTACT_SURFACE_H_
