// What the actuators of an MJCF can exert on its joints.
#ifndef ROLLGAIT_CLIENT_IMPORT_MJCF_ACTUATORS_H_
#define ROLLGAIT_CLIENT_IMPORT_MJCF_ACTUATORS_H_

#include <limits>
#include <map>
#include <set>
#include <string>

#include "client/import/link_tree.h"
#include "client/import/mjcf_values.h"

namespace rollgait::client {

// A range of forces, N m or N; as it is made: no limit.
struct ForceRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};
// A pair of attributes, such as ctrllimited and ctrlrange. Throws Failure(kUsage) for an empty range.
ForceRange ReadForceRange(const MjcfElement& element, const char* limited, const char* range);

// What the actuators of a file need to know of its joints, by name.
struct ActuatedJoints {
  std::set<std::string> base;                // those that the floating base stands for
  std::map<std::string, ForceRange> ranges;  // actuatorfrcrange, which no sum of actuators exceeds
  std::set<std::string> balls;               // which the tree has as turns (MjcfTurnName)
  std::set<std::string> driven;              // of the tree, those that an actuator drives; filled by AddMjcfActuator
};

// Adds the effort of one actuator to the joint that it drives: gear times control range, and no more than force
// range and the range of the joint; of a ball joint to the turn about the one axis that gear has. Returns whether it is
// of a joint of the tree, else says in `left_out` what it is. Throws Failure(kUsage) for a joint that the file does not
// have and for empty ranges.
bool AddMjcfActuator(const MjcfElement& actuator, ActuatedJoints* joints, LinkTree* tree, LeftOut* left_out);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MJCF_ACTUATORS_H_
