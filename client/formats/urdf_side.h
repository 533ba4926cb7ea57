// What a model has and its URDF does not say, as a side file.
#ifndef ROLLGAIT_CLIENT_FORMATS_URDF_SIDE_H_
#define ROLLGAIT_CLIENT_FORMATS_URDF_SIDE_H_

#include <string>

#include "rollgait/v1/model_side_file.pb.h"

namespace rollgait::client {

// With ToUrdf(model) it reads back as the same model: roles, sides, what drives the joints, limits that URDF cannot
// state, mirror images, contacts, bodies. The model's base are joints of that URDF. Contract: contacts and bodies are
// on joints of the model.
v1::ModelSideFile SideFileOfModel(const v1::Model& model);

// The same as proto3 JSON.
std::string ToUrdfSide(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_URDF_SIDE_H_
