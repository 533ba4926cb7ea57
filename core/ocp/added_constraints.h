#ifndef ROLLGAIT_CORE_OCP_ADDED_CONSTRAINTS_H_
#define ROLLGAIT_CORE_OCP_ADDED_CONSTRAINTS_H_

#include <compare>
#include <cstddef>
#include <vector>

namespace rollgait {

// An edge of the friction pyramid of a contact in space (core/ocp/constraints/friction.h) beyond the usual ones.
struct FrictionEdge {
  static constexpr int kDirections = 72;
  int contact = 0;    // index in the problem
  int direction = 0;  // 0 … kDirections − 1, in steps of 5° from x towards y
  friend auto operator<=>(const FrictionEdge&, const FrictionEdge&) = default;
};

// Joints whose range, velocity or effort is bounded at every instant of a phase, those of all joints are at nodes or
// points; and edges that the friction pyramids have in that phase, ascending.
struct BoundedBetween {
  std::vector<int> range = {}, velocity = {}, effort = {};
  std::vector<FrictionEdge> friction = {};
  friend bool operator==(const BoundedBetween&, const BoundedBetween&) = default;
};

// Constraints that are left out until a motion is seen to violate them, and edges that are left out until flat sides
// are seen to cost something: most of them never matter, and each costs time.
struct AddedConstraints {
  std::vector<BoundedBetween> between;  // one a phase; fewer: none there
  std::vector<int> separated;           // pairs of bodies that are kept apart, ascending
  // The edges that were added in a phase.
  const std::vector<FrictionEdge>& Edges(int phase) const {
    static const std::vector<FrictionEdge> kNone;
    return phase < static_cast<int>(between.size()) ? between[static_cast<size_t>(phase)].friction : kNone;
  }
  friend bool operator==(const AddedConstraints&, const AddedConstraints&) = default;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_ADDED_CONSTRAINTS_H_
