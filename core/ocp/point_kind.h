#ifndef ROLLGAIT_CORE_OCP_POINT_KIND_H_
#define ROLLGAIT_CORE_OCP_POINT_KIND_H_

namespace rollgait {

// What a point of the scheme is, and with it what it has rows for:
//   kCollocation  contacts roll (velocities), surfaces that swing are clear of the ground;
//   kNode         a node whose velocity rolls already, since the interval before ends there: contacts go on rolling
//                 (accelerations), and gaps are bounded in the interval before;
//   kStage        a stage of an explicit method, whose velocity the stages before it give: contacts go on rolling
//                 (accelerations), surfaces that swing are clear of the ground. Velocities at the nodes then roll as
//                 well as the method integrates.
enum class PointKind { kCollocation, kNode, kStage };

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_POINT_KIND_H_
