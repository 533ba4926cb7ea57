#ifndef ROLLGAIT_SERVER_CONVERT_JOINT_CHAINS_H_
#define ROLLGAIT_SERVER_CONVERT_JOINT_CHAINS_H_

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/models/joint_chain.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::server {

// Universal and ball joints of a model as the chains of revolute joints that they are: every other field is as it was,
// indices are those of the longer list.
struct UnfoldedModel {
  v1::Model model;
  std::vector<JointChain> chains;
};

// Violations, with `prefix` before their path in the given model: another number of coordinates than the type has, a
// field that belongs to the coordinates but is set beside them, indices out of range, a mirror image of another type.
// The model is then of no use. One without such joints comes back as it is.
UnfoldedModel UnfoldJointChains(const std::string& prefix, const v1::Model& model, Violations* violations);

// The same model with the chains written as one joint each. Contract: what UnfoldJointChains makes of a model, or the
// same after checks that change no tree.
v1::Model FoldJointChains(const v1::Model& unfolded, const std::vector<JointChain>& chains);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_JOINT_CHAINS_H_
