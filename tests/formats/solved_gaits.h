// Gaits that rollgait-solve made before the tests of the formats run, from the requests in specs/.
#ifndef ROLLGAIT_TESTS_FORMATS_SOLVED_GAITS_H_
#define ROLLGAIT_TESTS_FORMATS_SOLVED_GAITS_H_

#include <Eigen/Core>
#include <ostream>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// "planar": on a slope. "human": 29 joints on a slope, feet of two ellipsoids. "toes": a female body with toes, without
// arms, one hip locked, both halves of the cycle on their own, gravity 9 m/s². "ball": a manoeuvre of an ellipsoid,
// which is no gait: without feet and events, with a joint chart of its own.
inline const std::vector<std::string> kGaits = {"planar", "human", "toes"};
inline const std::vector<std::string> kMotions = {"planar", "human", "toes", "ball"};

// Some effort of the motion is larger, N m: so much that a difference of 1e-8 means something.
inline double LeastEffort(const std::string& name) { return name == "ball" ? 1e-3 : 50; }

v1::Solve ReadGait(const std::string& name);

// A collocation point as the equations of motion see it: positions are the stage positions of TrajectoryPhase. Vectors
// are in the order of Model.joints; efforts are zero where there is no actuator.
struct StagePoint {
  double time_s;
  Eigen::VectorXd position, velocity, acceleration, effort;
  // Of the ground on contact c of Model.contacts, N, world axes; zero where it does not touch.
  std::vector<Eigen::Vector3d> force;
};
std::vector<StagePoint> StagePoints(const v1::Solve& solve);

// The lowest point of an ellipsoid at `center` with semi-axes along the columns of `axes`.
Eigen::Vector3d LowestOf(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& semi_axes);

// A folder of this test for files that other libraries read by name.
std::string WriteScratch(const std::string& name, const std::string& content);

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_FORMATS_SOLVED_GAITS_H_
