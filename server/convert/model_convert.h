#ifndef ROLLGAIT_SERVER_CONVERT_MODEL_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_MODEL_CONVERT_H_

#include "core/models/catalog.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::server {

v1::ModelSummary EncodeSummary(const CatalogEntry& entry);

// How universal and ball joints are written: as the model has them, or as results do, each coordinate a joint.
enum class JointForm { kAsGiven, kChains };

// The whole scene. `gravity` is its magnitude in m/s².
v1::Model EncodeModel(const Scene& scene, double gravity, JointForm form = JointForm::kAsGiven);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_MODEL_CONVERT_H_
