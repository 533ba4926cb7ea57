#ifndef ROLLGAIT_CORE_MODELS_SIDES_ALIKE_H_
#define ROLLGAIT_CORE_MODELS_SIDES_ALIKE_H_

#include <string>
#include <vector>

#include "core/models/body_selection.h"

namespace rollgait {

// The request for a human without what makes its left and right differ. What both sides have alike stays (joints by
// their mirror images), and so does what belongs to the middle: there a load that lies to one side comes to lie in the
// middle, and a joint that is locked, or whose spring rests, to one side is so at zero. Lengths, feet, loads,
// strengths, springs and locked joints of one side that the other does not have are left out. Contract: BuildScene
// accepts the request, and it is one for a human.
BodyRequest WithSidesAlike(BodyRequest request);

// The fields of the request that WithSidesAlike changes or leaves out, joint_springs["ankle_l"], and "own" of a model
// of its own. The same contract.
std::vector<std::string> OneSidedFields(const BodyRequest& request);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SIDES_ALIKE_H_
