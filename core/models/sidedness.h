#ifndef ROLLGAIT_CORE_MODELS_SIDEDNESS_H_
#define ROLLGAIT_CORE_MODELS_SIDEDNESS_H_

#include <string>
#include <vector>

#include "core/models/body_selection.h"
#include "core/multibody/model.h"

namespace rollgait {

// The fields of the request that make its left and right differ, "joint_springs["ankle_l"]", without those that say
// the same of both sides.
std::vector<std::string> OneSidedFields(const BodyRequest& request);

// Whether the selection asks for anything that could make left and right differ, locked joints and feet apart.
bool MayBeOneSided(const BodySelection& selection);

// The request without what may make left and right differ: loads, strengths, springs, lengths and feet of one side, and
// locked joints whose mirror image is not locked alike.
BodyRequest WithSidesAlike(BodyRequest request);

// Whether the mirror image of the joints is themselves: links, limits and springs, to 1e-9 of masses, lengths in m and
// inertias. Contract: joint frames have the axes of their parents, as those of the human have.
bool AreMirrored(const std::vector<Joint>& joints);

// The joints as those of a body whose left and right differ: every one is its own mirror image, with sign 1.
void ForgetMirror(std::vector<Joint>* joints);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SIDEDNESS_H_
