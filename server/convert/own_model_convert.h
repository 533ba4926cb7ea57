#ifndef ROLLGAIT_SERVER_CONVERT_OWN_MODEL_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_OWN_MODEL_CONVERT_H_

#include <memory>
#include <string>

#include "core/models/own_model.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::server {

// Translates a model that a request carries; OwnScene checks it. Violations, each with `prefix` before its path: more
// parts than are read (kMaxOwnJoints and its like), enum values without a name, tensors, rotations and directions of
// another shape, names of mirror images and bodies that the model does not have. Orientations that are the identity
// come back to the bit, others to rounding; every other number to the bit.
std::shared_ptr<const OwnModel> DecodeOwnModel(const std::string& prefix, const v1::Model& model,
                                               Violations* violations);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_OWN_MODEL_CONVERT_H_
