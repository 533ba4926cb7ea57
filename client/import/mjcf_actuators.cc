#include "client/import/mjcf_actuators.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "client/import/mjcf_joint.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

ForceRange Scaled(const ForceRange& span, double factor) {
  if (factor == 0) return {0, 0};
  return factor > 0 ? ForceRange{factor * span.least, factor * span.most}
                    : ForceRange{factor * span.most, factor * span.least};
}

// Whether the force is a gain times the control, and which gain.
bool IsProportional(const MjcfElement& actuator, double* gain) {
  const std::string kind = actuator.xml().Name();
  const auto is = [&](const char* attribute, const char* word) {
    const char* const text = actuator.Get(attribute);
    return text == nullptr || std::strcmp(text, word) == 0;
  };
  *gain = 1;
  if (kind == "motor") return true;
  const bool filters = is("dyntype", "none") || is("dyntype", "filter") || is("dyntype", "filterexact");
  if (kind != "general" || !is("gaintype", "fixed") || !is("biastype", "none") || !filters) return false;
  const std::vector<double> gains = actuator.Numbers("gainprm", 1, 20);
  if (!gains.empty()) *gain = gains[0];
  return true;
}

ForceRange Common(const ForceRange& a, const ForceRange& b) {
  return {std::max(a.least, b.least), std::min(a.most, b.most)};
}

}  // namespace

ForceRange ReadForceRange(const MjcfElement& element, const char* limited, const char* range) {
  if (!element.IsLimited(limited, range)) return {};
  const std::vector<double> ends = element.Numbers(range, 2, 2);
  if (ends.empty() || !(ends[0] < ends[1])) {
    element.Refuse(std::string(range) + " must have two numbers, the lower below the upper");
  }
  return {ends[0], ends[1]};
}

bool AddMjcfActuator(const MjcfElement& actuator, ActuatedJoints* joints, LinkTree* tree, LeftOut* left_out) {
  const tinyxml2::XMLElement& xml = actuator.xml();
  const std::string kind = xml.Name();
  const char* const attribute = xml.Attribute("joint") != nullptr ? "joint" : "jointinparent";
  if (kind == "muscle" || kind == "adhesion" || kind == "plugin" || xml.Attribute(attribute) == nullptr) {
    left_out->Add(xml, "a model is driven by efforts of joints; give effortMin and effortMax in the side file");
    return false;
  }
  std::string joint_name = actuator.source().Name(xml, attribute);
  std::vector<double> gear = actuator.Overlaid("gear", 6);
  if (gear.empty()) gear = {1};
  gear.resize(3, 0);
  int along = 0;  // component of gear
  if (joints->balls.count(joint_name) != 0) {
    const auto is_zero = [](double value) { return value == 0; };
    if (std::count_if(gear.begin(), gear.begin() + 3, is_zero) != 2) {
      for (const int axis : {0, 1, 2}) joints->driven.insert(MjcfTurnName(joint_name, axis));
      left_out->Add(xml,
                    "it drives a ball joint about an oblique axis; give effortMin and effortMax of the joint's "
                    "turns in the side file");
      return true;
    }
    while (gear[static_cast<size_t>(along)] == 0) ++along;
    joint_name = MjcfTurnName(joint_name, along);
  }
  if (joints->base.count(joint_name) != 0) {
    left_out->Add(xml, "it drives the base, which floats");
    return true;
  }
  const int index = tree->FindJoint(joint_name);
  if (index < 0) actuator.Refuse("drives the joint \"" + joint_name + "\", which the file does not have");
  TreeJoint& joint = tree->joints[static_cast<size_t>(index)];
  joint.driven = true;
  joints->driven.insert(joint_name);
  double gain = 1;
  ForceRange force = ReadForceRange(actuator, "forcelimited", "forcerange");
  if (IsProportional(actuator, &gain)) {
    force = Common(force, Scaled(ReadForceRange(actuator, "ctrllimited", "ctrlrange"), gain));
  }
  force = Scaled(force, gear[static_cast<size_t>(along)]);
  const auto limit = joints->ranges.find(joint_name);
  const ForceRange most = limit == joints->ranges.end() ? ForceRange() : limit->second;
  force = Common(force, most);
  if (!std::isfinite(force.most - force.least)) {
    left_out->Add(xml, "no range limits its force; give effortMin and effortMax in the side file");
    return true;
  }
  joint.effort_min = std::max(joint.effort_min + std::min(force.least, 0.0), std::min(most.least, 0.0));
  joint.effort_max = std::min(joint.effort_max + std::max(force.most, 0.0), std::max(most.most, 0.0));
  return true;
}

}  // namespace rollgait::client
