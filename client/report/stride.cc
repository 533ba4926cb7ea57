#include "client/report/stride.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "client/failure.h"
#include "client/joint_kinds.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

int MirrorContact(const v1::Model& model, int contact) {
  const std::string& name = model.contacts(contact).mirror_contact();
  for (int i = 0; i < model.contacts_size(); ++i) {
    if (model.contacts(i).name() == name) return i;
  }
  throw Failure(ExitCode::kUsage, "model.contacts[" + std::to_string(contact) + "].mirror_contact is \"" + name +
                                      "\", which is no contact of the model");
}

}  // namespace

std::vector<double> ForwardShift(const v1::Model& model, double displacement_m) {
  std::vector<double> shift(model.joints_size(), 0.0);
  const std::vector<double> zero(model.joints_size(), 0.0);
  const std::vector<Pose> poses = LinkPoses(model, zero);
  std::vector<bool> at_root(model.joints_size(), false);
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    const bool free = IsSlide(joint) && !joint.actuated();
    at_root[i] = free && (joint.parent() < 0 || at_root[joint.parent()]);
    const Eigen::Vector3d axis(joint.axis().x(), joint.axis().y(), joint.axis().z());
    if (at_root[i]) shift[i] = displacement_m * (poses[i].rotation * axis).x();
  }
  return shift;
}

Instant Mirror(const Instant& instant, const v1::Model& model) {
  Instant image = instant;
  for (int i = 0; i < model.joints_size(); ++i) {
    const int to = model.joints(i).mirror_joint();
    const double sign = model.joints(i).mirror_sign();
    if (to < 0 || to >= model.joints_size()) {
      throw Failure(ExitCode::kUsage, "model.joints[" + std::to_string(i) + "].mirror_joint is " + std::to_string(to) +
                                          ", must be in [0, " + std::to_string(model.joints_size() - 1) + "]");
    }
    image.position[to] = sign * instant.position[i];
    image.velocity[to] = sign * instant.velocity[i];
    image.effort[to] = sign * instant.effort[i];
  }
  for (int c = 0; c < model.contacts_size(); ++c) {
    const int to = MirrorContact(model, c);
    image.active[to] = instant.active[c];
    image.force[to] = {instant.force[c][0], -instant.force[c][1], instant.force[c][2]};
  }
  return image;
}

Stride BuildStride(const v1::Trajectory& trajectory, const v1::Model& model, double start_s, int intervals) {
  const Motion motion(trajectory, model);
  const bool is_half = trajectory.cycle() != v1::CYCLE_FULL && trajectory.cycle() != v1::CYCLE_ONCE;
  const StrideSource source{motion.duration_s(), motion.displacement_m(), is_half,
                            [&motion](double time_s, bool from_left) { return motion.At(time_s, from_left); }};
  return BuildStride(source, model, start_s, intervals);
}

Stride BuildStride(const StrideSource& source, const v1::Model& model, double start_s, int intervals) {
  const bool half = source.is_half;
  const double span = source.duration_s;

  Stride stride;
  stride.duration_s = half ? 2 * span : span;
  stride.displacement_m = half ? 2 * source.displacement_m : source.displacement_m;
  if (!(start_s >= 0 && start_s < stride.duration_s)) {
    throw Failure(ExitCode::kUsage, "gait_events.start_s is " + std::to_string(start_s) + ", must be in [0, " +
                                        std::to_string(stride.duration_s) + ")");
  }
  const std::vector<double> shift = ForwardShift(model, source.displacement_m);

  // The instant at time t ≥ 0 from the start of the trajectory, any number of spans later.
  const auto at = [&](double t, bool from_left) {
    const double tolerance = (from_left ? -1e-9 : 1e-9) * span;
    const int spans = std::max(0, static_cast<int>(std::floor((t + tolerance) / span)));
    Instant instant = source.at(t - spans * span, from_left);
    if (half && spans % 2 == 1) instant = Mirror(instant, model);
    for (size_t i = 0; i < shift.size(); ++i) instant.position[i] += spans * shift[i];
    return instant;
  };
  for (int i = 0; i <= intervals; ++i) {
    const double time = stride.duration_s * i / intervals;
    stride.samples.push_back({100.0 * i / intervals, time, at(start_s + time, i == intervals)});
  }
  return stride;
}

}  // namespace rollgait::client
