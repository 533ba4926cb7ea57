// The whole gait cycle, from heel strike to heel strike of one foot, made from a half or a full cycle.
#ifndef ROLLGAIT_CLIENT_REPORT_STRIDE_H_
#define ROLLGAIT_CLIENT_REPORT_STRIDE_H_

#include <vector>

#include "client/report/motion.h"

namespace rollgait::client {

struct StrideSample {
  double percent;  // of the gait cycle, [0, 100]
  double time_s;   // from the heel strike
  Instant instant;
};

struct StridePhase {
  double start_percent, end_percent;
  std::vector<int> contacts;  // indices into Model.contacts, ascending
};

// A contact begins (heel strike) or ends (toe-off).
struct StrideEvent {
  double percent;  // [0, 100)
  int contact;     // index into Model.contacts
  bool touch_down;
};

struct Stride {
  double duration_s;
  double displacement_m;
  // The contact whose touch-down is 0 %: that of the right leg (a joint whose name ends in "_r") if there is one, else
  // the first one that touches down.
  int reference_contact;
  // Equally spaced, 0 % and 100 % included; the last one is the limit from the left. The body keeps moving forward: the
  // last position is the first one moved by displacement_m.
  std::vector<StrideSample> samples;
  std::vector<StridePhase> phases;  // in order, from 0 to 100 %
  std::vector<StrideEvent> events;  // in order
};

// The cycle at `intervals` + 1 instants. A half cycle is completed by its mirror image (Joint.mirror_joint,
// mirror_sign, ContactSurface.mirror_contact). Throws Failure(kUsage) if trajectory, model or mirror data do not fit.
Stride BuildStride(const v1::Trajectory& trajectory, const v1::Model& model, int intervals);

// The left/right mirror image of an instant, without the forward shift.
Instant Mirror(const Instant& instant, const v1::Model& model);

// What is added to each joint's position when the body is moved by `displacement_m` along x: non-zero only for the
// prismatic joints at the root of the tree.
std::vector<double> ForwardShift(const v1::Model& model, double displacement_m);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_STRIDE_H_
