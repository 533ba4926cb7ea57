#ifndef ROLLGAIT_CORE_SIMULATION_GROUND_MOTION_H_
#define ROLLGAIT_CORE_SIMULATION_GROUND_MOTION_H_

#include "core/base/types.h"
#include "core/contact/contact_pair.h"

namespace rollgait {

// Prescribed motion of a ground frame in world axes: it turns by θ(t) about a fixed axis through a pivot that is
// displaced by d(t). All zero: the ground is the world. Covers treadmill (velocity), turntable (rate about the normal),
// tilting and shaken platforms (swing, amplitude), accelerating planes.
struct GroundMotion {
  // d(t) = velocity t + acceleration t²/2 + amplitude sin(2π frequency t + phase)
  Vector3 velocity = Vector3::Zero();      // m/s
  Vector3 acceleration = Vector3::Zero();  // m/s²
  Vector3 amplitude = Vector3::Zero();     // m
  double frequency = 0;                    // Hz
  double phase = 0;                        // rad
  // θ(t) = rate t + angular_acceleration t²/2 + swing sin(2π swing_frequency t + swing_phase)
  Vector3 axis = Vector3::UnitZ();  // unit, world
  Vector3 pivot = Vector3::Zero();  // m, in the ground frame, which is the world's while θ = 0 and d = 0
  double rate = 0;                  // rad/s
  double angular_acceleration = 0;  // rad/s²
  double swing = 0;                 // rad
  double swing_frequency = 0;       // Hz
  double swing_phase = 0;           // rad

  bool IsFixed() const {
    return velocity.isZero(0) && acceleration.isZero(0) && amplitude.isZero(0) && rate == 0 &&
           angular_acceleration == 0 && swing == 0;
  }
};

// The frame at time t (s) with its full classical accelerations.
FrameMotion MotionAt(const GroundMotion& motion, double t);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_GROUND_MOTION_H_
