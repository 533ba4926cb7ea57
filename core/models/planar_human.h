#ifndef ROLLGAIT_CORE_MODELS_PLANAR_HUMAN_H_
#define ROLLGAIT_CORE_MODELS_PLANAR_HUMAN_H_

#include "core/models/scene.h"

namespace rollgait {

// The entry "planar" of the catalogue: the human (human.h) restricted to the sagittal plane, without arms and with a
// rigid trunk. 9 degrees of freedom in this order: base_x, base_z (m, world), base_pitch (forward lean positive), then
// hip, knee, ankle of the left and of the right leg (rad; flexion, flexion, dorsiflexion positive). The base frame is
// the middle of the hip joint centres; pelvis, torso, head and hanging arms are one rigid trunk on it. Contacts:
// left_foot, right_foot, ellipsoids whose sole has the radius of curvature 0.3 × leg length. Contract: stature (m) in
// [1.0, 2.3] and mass (kg) in [20, 250].
Scene PlanarHuman(Sex sex, double stature, double mass);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_PLANAR_HUMAN_H_
