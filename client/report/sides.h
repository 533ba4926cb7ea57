// Which side of the body the parts of a model are on.
#ifndef ROLLGAIT_CLIENT_REPORT_SIDES_H_
#define ROLLGAIT_CLIENT_REPORT_SIDES_H_

#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// The numbers are those on the page.
enum class Side { kMiddle = 0, kRight = 1, kLeft = 2 };

// Of each joint and the link it moves: what hangs on a joint is on the joint's side. A joint of the middle begins a
// side if its name ends in "_r" or "_l", or else if its mirror image is another joint and it lies right (y < 0) or left
// of it in the zero posture.
std::vector<Side> JointSides(const v1::Model& model);

// Whether left and right differ: then every joint is its own mirror image.
bool IsOneSided(const v1::Model& model);

// "knee" of "knee_r" and "knee_l"; other names stay.
std::string WithoutSide(const std::string& name);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_SIDES_H_
