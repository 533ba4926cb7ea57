#include "client/paper/slope_figures.h"

#include <algorithm>
#include <cmath>

#include "client/failure.h"
#include "client/gait_events_table.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Samples of a stride, for the trapezoidal rule.
constexpr int kIntervals = 2000;

JointEffort MeasureJoint(const v1::Model& model, int joint, const Stride& stride) {
  JointEffort effort{model.joints(joint).name(), 0, 0, 0, 0, 0};
  for (size_t i = 0; i < stride.samples.size(); ++i) {
    const bool end = i == 0 || i + 1 == stride.samples.size();
    const double weight = stride.duration_s / kIntervals * (end ? 0.5 : 1);
    const double torque = stride.samples[i].instant.effort[joint];
    const double power = torque * stride.samples[i].instant.velocity[joint];
    effort.squared += weight * torque * torque;
    effort.absolute += weight * std::abs(torque);
    (power > 0 ? effort.positive_work : effort.negative_work) += weight * std::abs(power);
    effort.peak = std::max(effort.peak, std::abs(torque));
  }
  return effort;
}

bool IsShown(const std::string& joint) {
  for (const char* name : {"hip_r", "knee_r", "ankle_r", "hip_l", "knee_l", "ankle_l"}) {
    if (joint == name) return true;
  }
  return false;
}

}  // namespace

SlopeFigures MeasureSlope(const v1::Solve& solve) {
  const v1::SolveResult& result = solve.result();
  SlopeFigures figures;
  figures.slope_deg = solve.spec().slope_rad() * 180 / kPi;
  figures.solve = solve.name();
  figures.wall_time_s = result.wall_time_s();
  if (!result.has_trajectory() || result.trajectory().phases_size() == 0 || !result.has_model()) return figures;
  figures.solved = HasSolution(solve);
  figures.mirrored = result.trajectory().cycle() != v1::CYCLE_FULL;

  const v1::Model& model = result.model();
  const v1::GaitEvents& events = result.gait_events();
  const Stride stride = BuildStride(result.trajectory(), model, events.start_s(), kIntervals);
  figures.stride_time_s = stride.duration_s;
  figures.stride_length_m = stride.displacement_m;
  figures.events = {FirstEvent(events, v1::GaitEvent::KIND_TOE_OFF, v1::FOOT_LEFT),
                    FirstEvent(events, v1::GaitEvent::KIND_HEEL_STRIKE, v1::FOOT_LEFT),
                    FirstEvent(events, v1::GaitEvent::KIND_TOE_OFF, v1::FOOT_RIGHT)};
  for (const v1::SupportPhase& phase : events.phases()) {
    figures.phases.push_back({phase.start_percent(),
                              phase.end_percent(),
                              (phase.end_percent() - phase.start_percent()) / 100 * events.duration_s(),
                              phase.feet_size(),
                              {phase.contacts().begin(), phase.contacts().end()}});
  }
  figures.total.joint = "all joints";
  for (int j = 0; j < model.joints_size(); ++j) {
    if (!model.joints(j).actuated()) continue;
    const JointEffort effort = MeasureJoint(model, j, stride);
    figures.total.squared += effort.squared;
    figures.total.absolute += effort.absolute;
    figures.total.positive_work += effort.positive_work;
    figures.total.negative_work += effort.negative_work;
    if (IsShown(effort.joint)) figures.total.peak = std::max(figures.total.peak, effort.peak);
    figures.joints.push_back(effort);
  }
  return figures;
}

}  // namespace rollgait::client
