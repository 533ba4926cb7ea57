#ifndef ROLLGAIT_CORE_OCP_ADDED_CONSTRAINTS_H_
#define ROLLGAIT_CORE_OCP_ADDED_CONSTRAINTS_H_

#include <vector>

namespace rollgait {

// Joints whose range, velocity or effort is bounded at every instant of a phase; those of all joints are at nodes or
// points.
struct BoundedBetween {
  std::vector<int> range, velocity, effort;
  friend bool operator==(const BoundedBetween&, const BoundedBetween&) = default;
};

// Constraints that are left out until a motion is seen to violate them: most of them never matter, and each costs time.
struct AddedConstraints {
  std::vector<BoundedBetween> between;  // one a phase; fewer: none there
  std::vector<int> separated;           // pairs of bodies that are kept apart, ascending
  friend bool operator==(const AddedConstraints&, const AddedConstraints&) = default;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_ADDED_CONSTRAINTS_H_
