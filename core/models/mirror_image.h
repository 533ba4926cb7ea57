#ifndef ROLLGAIT_CORE_MODELS_MIRROR_IMAGE_H_
#define ROLLGAIT_CORE_MODELS_MIRROR_IMAGE_H_

#include <vector>

#include "core/contact/contact_surface.h"
#include "core/multibody/model.h"

namespace rollgait {

// Whether the range [min, max] of a joint is the mirror image of that of its mirror joint, to the bit.
bool IsMirroredRange(double min, double max, double image_min, double image_max, double mirror_sign);

// Whether springs and dampers of two joints are mirror images of each other, to the bit. Where a spring rests says
// nothing of one without stiffness.
bool HasMirroredSpring(const Joint& joint, const Joint& image);

// What of a body its motion can feel: all of it, or in the sagittal plane nothing of where things are beside it.
enum class MotionSpace { kSpace, kSagittalPlane };

// Whether the left/right mirror image (y → −y) of a body is the body itself, with the mirror joints that its joints
// name: axes, links and contacts at position zero, to 1e-9 of m and of masses and inertias; ranges, limits, springs and
// passive torques to the bit. In the sagittal plane the y of origins, centres of mass and contacts, and inertias but
// those of turns about y, do not count. Contract: no free joints; in kSagittalPlane every joint moves in the plane.
bool IsOwnMirrorImage(const Model& model, const std::vector<ContactSurface>& contacts, MotionSpace space);

// The same body whose joints are their own mirror images with sign 1: one whose left and right differ.
Model WithoutMirror(const Model& model);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_MIRROR_IMAGE_H_
