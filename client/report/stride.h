// The whole gait cycle as a function of time, made from a half or a full cycle. What happens in it is in
// rollgait.v1.GaitEvents.
#ifndef ROLLGAIT_CLIENT_REPORT_STRIDE_H_
#define ROLLGAIT_CLIENT_REPORT_STRIDE_H_

#include <functional>
#include <vector>

#include "client/report/motion.h"

namespace rollgait::client {

struct StrideSample {
  double percent;  // of the gait cycle, [0, 100]
  double time_s;   // from 0 %
  Instant instant;
};

struct Stride {
  double duration_s;
  double displacement_m;
  // Equally spaced, 0 % and 100 % included; the last one is the limit from the left. The body keeps moving forward: the
  // last position is the first one moved by displacement_m.
  std::vector<StrideSample> samples;
};

// The cycle at `intervals` + 1 instants from `start_s` (GaitEvents.start_s; 0 where there are no events) after the
// start of the trajectory on. A half cycle is completed by its mirror image (Joint.mirror_joint, mirror_sign,
// ContactSurface.mirror_contact). Throws Failure(kUsage) if trajectory, model, mirror data or start_s (less than the
// length of the cycle) do not fit.
Stride BuildStride(const v1::Trajectory& trajectory, const v1::Model& model, double start_s, int intervals);

// A motion over a half or a whole cycle.
struct StrideSource {
  double duration_s;
  double displacement_m;
  bool is_half;  // the rest is its mirror image
  // The instant at a time in [0, duration]; on a border between phases that of the earlier one if `from_left`.
  std::function<Instant(double time_s, bool from_left)> at;
};

// The same of any motion.
Stride BuildStride(const StrideSource& source, const v1::Model& model, double start_s, int intervals);

// The left/right mirror image of an instant, without the forward shift.
Instant Mirror(const Instant& instant, const v1::Model& model);

// What is added to each joint's position when the body is moved by `displacement_m` along x: non-zero only for the
// prismatic joints at the root of the tree.
std::vector<double> ForwardShift(const v1::Model& model, double displacement_m);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_STRIDE_H_
