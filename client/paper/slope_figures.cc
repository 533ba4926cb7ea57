#include "client/paper/slope_figures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Samples of a stride, for the trapezoidal rule.
constexpr int kIntervals = 2000;

// "_l", "_r" or nothing.
std::string SideOf(const v1::Model& model, int contact) {
  const std::string& joint = model.joints(model.contacts(contact).joint()).name();
  const std::string end = joint.size() > 2 ? joint.substr(joint.size() - 2) : "";
  return end == "_l" || end == "_r" ? end : "";
}

int Feet(const v1::Model& model, const std::vector<int>& contacts) {
  std::set<std::string> sides;
  for (const int contact : contacts) sides.insert(SideOf(model, contact));
  return static_cast<int>(sides.size());
}

bool Touches(const v1::Model& model, const StridePhase& phase, bool reference_side, const std::string& reference) {
  return std::any_of(phase.contacts.begin(), phase.contacts.end(),
                     [&](int contact) { return (SideOf(model, contact) == reference) == reference_side; });
}

CycleEvents FindEvents(const v1::Model& model, const Stride& stride) {
  CycleEvents events;
  if (stride.reference_contact < 0) return events;
  const std::string reference = SideOf(model, stride.reference_contact);
  for (size_t i = 1; i < stride.phases.size(); ++i) {
    const double at = stride.phases[i].start_percent;
    const auto changes = [&](bool side, bool on) {
      return Touches(model, stride.phases[i], side, reference) == on &&
             Touches(model, stride.phases[i - 1], side, reference) != on;
    };
    if (!events.opposite_toe_off && changes(false, false)) events.opposite_toe_off = at;
    if (!events.opposite_heel_strike && changes(false, true)) events.opposite_heel_strike = at;
    if (!events.toe_off && changes(true, false)) events.toe_off = at;
  }
  return events;
}

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
  const Stride stride = BuildStride(result.trajectory(), model, kIntervals);
  figures.stride_time_s = stride.duration_s;
  figures.stride_length_m = stride.displacement_m;
  figures.events = FindEvents(model, stride);
  for (const StridePhase& phase : stride.phases) {
    PhaseShare share{phase.start_percent, phase.end_percent,
                     (phase.end_percent - phase.start_percent) / 100 * stride.duration_s, Feet(model, phase.contacts), {}};
    for (const int contact : phase.contacts) share.contacts.push_back(model.contacts(contact).name());
    figures.phases.push_back(share);
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
