#ifndef ROLLGAIT_CORE_MODELS_HUMAN_SCENE_H_
#define ROLLGAIT_CORE_MODELS_HUMAN_SCENE_H_

#include "core/base/result.h"
#include "core/models/scene.h"

namespace rollgait {

// The human of the selection, reduced to what it moves (ReduceModel): its switches fix joints at zero, its locked
// joints at their angles.
//   sagittal     base_y, base_yaw, base_roll and every joint that does not turn about y; contacts work in x and z only.
//                Limbs keep their distance from the plane, and what is left of it says nothing of limbs that pass each
//                other: there are bodies, but no pairs
//   drop_arms    shoulders and elbows: straight hanging arms, one body with the torso
//   rigid_trunk  the three trunk joints: pelvis and torso are one body
// Its changes are made before (subject_changes.h). It is symmetric if it is its own mirror image (IsOwnMirrorImage), in
// the plane as far as the motion in the plane can feel; if not, its joints have no mirror images but themselves.
// Violations name the fields of ModelSelection: segment lengths of unknown segments or out of range; toes without feet
// of two ellipsoids; locked joints that are unknown, fixed already, of the base, out of range, or all there are.
// Contract: stature and mass within the ranges of ModelSelection.
Result<Scene> HumanScene(const BodySelection& selection);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_HUMAN_SCENE_H_
