// Whether a point lies in the reference's minimum, and whether its error is known well.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_MINIMUM_H_
#define ROLLGAIT_CLIENT_TRADEOFF_MINIMUM_H_

#include <optional>

namespace rollgait::client {

// kUnknown: the point is far from the reference, and could not be followed to its mesh.
enum class Minimum { kSame, kOther, kUnknown };

// A point further from the reference is followed to the reference's mesh.
inline constexpr double kFarAngle_deg = 1;

// From the largest error of a joint angle, and from that of the solution on the reference's mesh that the solver
// reached from the point; none: it reached none. Another minimum keeps more than half of the point's error.
Minimum MinimumOf(double error_deg, std::optional<double> followed_error_deg);

// The last two meshes of the reference differ by at most half of the error.
bool IsWellKnown(double error_deg, double reference_difference_deg);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_MINIMUM_H_
