// How far apart two simulations of one scene are.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_SCENE_ERRORS_H_
#define ROLLGAIT_CLIENT_TRADEOFF_SCENE_ERRORS_H_

#include <optional>

#include "rollgait/v1/simulation.pb.h"

namespace rollgait::client {

// The largest of all joints and samples.
struct SceneErrors {
  double position_m = 0;               // of sliding joints, and of the origin of free ones
  double angle_deg = 0;                // of turning joints, and the rotation between orientations of free ones
  double velocity_m_s = 0;             // as position_m, free joints in axes of the joint frame
  double angular_velocity_deg_s = 0;   // as angle_deg, likewise
  std::optional<double> event_time_s;  // of the same event; none: there are no events, or the motion is another
  bool same_motion = true;             // the same end, and at each contact the same events in order
  // The larger of position_m and the angle in rad: what the integrator's tolerances bound in a step, m and rad alike.
  double pose() const;
};

// Samples of the same time are compared. Velocities jump in an impact, so those between the times that the two say of
// one event are not. Throws Failure(kUsage) if no time is in both, or a sample does not fit the joints of `scene`.
SceneErrors ErrorsAgainst(const v1::SimulationScene& scene, const v1::Simulation& reference,
                          const v1::Simulation& simulation);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_SCENE_ERRORS_H_
