#ifndef ROLLGAIT_CORE_MODELS_PLANAR_HUMAN_H_
#define ROLLGAIT_CORE_MODELS_PLANAR_HUMAN_H_

#include "core/models/scene.h"

namespace rollgait {

// The human in the sagittal plane, 9 degrees of freedom in this order: base_x, base_z (m, world), base_pitch (forward lean
// positive), then hip, knee, ankle of the left and of the right leg (rad; flexion, flexion, dorsiflexion positive). The
// base frame is the middle of the hip joint centres; pelvis, torso, head and hanging arms are one rigid trunk on it.
// World: x forward, y left, z up, the ground's normal. All zero: standing straight with the hips at the world's origin.
// Contacts: left_foot, right_foot, ellipsoids whose sole has the radius of curvature 0.3 × leg length.
// Contract: stature (m) and mass (kg) finite and > 0.
Scene PlanarHuman(Sex sex, double stature, double mass);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_PLANAR_HUMAN_H_
