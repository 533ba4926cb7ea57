#ifndef ROLLGAIT_CORE_GAIT_SIMILARITY_H_
#define ROLLGAIT_CORE_GAIT_SIMILARITY_H_

#include <cmath>

namespace rollgait {

// Numbers of presets and defaults are given for a body of 75 kg at 9.81 m/s². These factors take them to another mass m
// and gravity g such that the same motion remains optimal, run through in another time: angles and lengths stay, and
// with Froude's number v²/(g L) so do all ratios of forces. 1 at 75 kg and 9.81 m/s², exactly.
struct Similarity {
  double mass = 1;                                     // m / 75 kg
  double gravity = 1;                                  // g / 9.81 m/s²; of accelerations, too
  double speed() const { return std::sqrt(gravity); }  // also of joints
  double time() const { return 1 / std::sqrt(gravity); }
  double torque() const { return mass * gravity; }  // and forces
  double power() const { return mass * gravity * std::sqrt(gravity); }
};

// Of time, s, of mass, kg, and of the objective, 1 of what the request weighs.
struct Units {
  double time = 1;
  double mass = 1;
  double objective = 1;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SIMILARITY_H_
