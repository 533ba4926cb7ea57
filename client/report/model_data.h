// What the page says about a model.
#ifndef ROLLGAIT_CLIENT_REPORT_MODEL_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_MODEL_DATA_H_

#include <nlohmann/json.hpp>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// {name, description, mass, stature, leg_length, one_sided, gravity, joints: [...], contacts: [...], sources: [...]};
// angles in degrees.
nlohmann::json ModelData(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_MODEL_DATA_H_
