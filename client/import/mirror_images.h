// The left/right mirror images of a model's joints, contacts and bodies.
#ifndef ROLLGAIT_CLIENT_IMPORT_MIRROR_IMAGES_H_
#define ROLLGAIT_CLIENT_IMPORT_MIRROR_IMAGES_H_

#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"
#include "rollgait/v1/model_side_file.pb.h"

namespace rollgait::client {

// 1 or -1: the sign with which `image` takes the value of `joint`, so that positive positions are mirror images where
// the axes at position zero allow it. Contract: parents first.
double MirrorSign(const v1::Model& model, int joint, int image);

// Sets mirror_joint, mirror_sign, mirror_contact and mirror_body of every part, as ModelSideFile.mirror says: by names,
// and joints whose names tell no side by places (1 mm), axes (3°) and masses (1 %) at position zero. Returns
// what was proposed, a sentence each. Throws Failure(kUsage) for a mirror image that is no part of the model.
std::vector<std::string> SetMirrorImages(const std::string& side_path, const v1::ModelSideFile& side, v1::Model* model);

// The first link or joint whose mirror image is not one, with both values; empty: left and right are mirror images to
// 1e-6 of masses, inertias and of the distance between the world's origin and the part (at least 1 m).
std::string MirrorDifference(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MIRROR_IMAGES_H_
