#ifndef ROLLGAIT_CORE_MODELS_SIDES_ALIKE_H_
#define ROLLGAIT_CORE_MODELS_SIDES_ALIKE_H_

#include "core/models/body_selection.h"

namespace rollgait {

// The request for a human without what makes its left and right differ. What both sides have alike stays (joints by
// their mirror images), and so does what belongs to the middle: there a load that lies to one side comes to lie in the
// middle, and a joint that is locked, or whose spring rests, to one side is so at zero. Lengths, loads, strengths,
// springs and locked joints of one side that the other does not have are left out. Contract: BuildScene accepts the
// request, and it is one for a human.
BodyRequest WithSidesAlike(BodyRequest request);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SIDES_ALIKE_H_
