// Accuracy bounds of the command line.
#ifndef ROLLGAIT_CLIENT_BOUND_FLAGS_H_
#define ROLLGAIT_CLIENT_BOUND_FLAGS_H_

#include <string>
#include <vector>

#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::client {

// Names of the bounds: the fields of rollgait.v1.Accuracy of type double whose name begins with max_.
std::vector<std::string> BoundNames();

// Sets the bounds "NAME=NUMBER", the unit being that of the field; later ones win. Throws Failure(kUsage) for a name
// that is not in BoundNames(), with the list, and for what is not a number. The server checks the ranges.
void ApplyBounds(const std::vector<std::string>& bounds, v1::Accuracy& accuracy);

// Sets the fields of max_error by "NAME=NUMBER": angle in degrees, torque in N m, contact-force in N, objective as a
// share. Throws Failure(kUsage) for another name, with the list, and for what is not a number.
void ApplyMaxErrors(const std::vector<std::string>& errors, v1::Accuracy& accuracy);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_BOUND_FLAGS_H_
