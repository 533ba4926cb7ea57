#include "core/models/sides_alike.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/field_path.h"
#include "core/models/human.h"
#include "core/models/sided_segment.h"

namespace rollgait {
namespace {

// Every joint that a human may have, with its mirror image.
Model WholeHuman() {
  const SegmentTable table(Sex::kMale, DefaultStature(Sex::kMale), DefaultMass(Sex::kMale));
  return Human(table, {.feet = FootShape::kTwoEllipsoids, .ranges = JointRanges::kAnatomical, .toes = true}).model;
}

bool AreEqual(double a, double b) { return a == b; }
bool AreEqual(const JointSpring& a, const JointSpring& b) {
  return a.stiffness == b.stiffness && a.damping == b.damping && (a.stiffness == 0 || a.rest == b.rest);
}

// Leaves out the values of joints whose mirror image has another one; `image(value, sign)` is what it has to have, and
// what a joint of the middle is given that does not mirror itself there.
template <typename Value, typename Image>
void KeepAlike(const Model& human, Image image, std::map<std::string, Value>* values) {
  const std::map<std::string, Value> given = *values;
  for (const auto& [name, value] : given) {
    const Joint& joint = human.joint(human.Find(name));
    const Value expected = image(value, joint.mirror_sign);
    const std::string& mirror = human.joint(joint.mirror_joint).name;
    if (mirror == name) {
      if (!AreEqual(value, expected)) (*values)[name] = image(value, 0);
      continue;
    }
    const auto other = given.find(mirror);
    if (other == given.end() || !AreEqual(other->second, expected)) values->erase(name);
  }
}

// "thigh_r" of "thigh_l"; a name without a side: itself.
std::string MirrorNameOf(std::string name) {
  if (name.ends_with("_l") || name.ends_with("_r")) name.back() = name.back() == 'l' ? 'r' : 'l';
  return name;
}

// The same of values of segments and surfaces.
template <typename Value>
void KeepAlike(std::map<std::string, Value>* values) {
  const std::map<std::string, Value> given = *values;
  for (const auto& [name, value] : given) {
    const auto other = given.find(MirrorNameOf(name));
    if (other == given.end() || other->second != value) values->erase(name);
  }
}

bool AreMirrored(const SegmentLoad& load, const SegmentLoad& other) {
  SegmentLoad image = other;
  if (image.position) image.position->z() *= -1;
  return load.segment == MirrorNameOf(other.segment) && load.mass == image.mass && load.position == image.position &&
         load.moments == image.moments;
}

// Of each load whether it or another is its mirror image.
std::vector<char> HaveImages(const std::vector<SegmentLoad>& loads) {
  std::vector<char> have(loads.size(), 0);
  for (size_t i = 0; i < loads.size(); ++i) {
    if (AreMirrored(loads[i], loads[i])) have[i] = 1;
    for (size_t k = i + 1; k < loads.size() && !have[i]; ++k) {
      if (!have[k] && AreMirrored(loads[i], loads[k])) have[i] = have[k] = 1;
    }
  }
  return have;
}

void KeepAlike(std::vector<SegmentLoad>* loads) {
  const std::vector<char> have = HaveImages(*loads);
  std::vector<SegmentLoad> alike;
  for (size_t i = 0; i < loads->size(); ++i) {
    SegmentLoad& load = (*loads)[i];
    const bool is_of_middle = FindSegment(load.segment)->side == BodySide::kMidline;
    if (is_of_middle && !have[i]) load.position->z() = 0;
    if (is_of_middle || have[i]) alike.push_back(std::move(load));
  }
  *loads = std::move(alike);
}

// The names whose values `alike` has otherwise or not at all, as keys of the field.
template <typename Value>
void AddChanged(const char* field, const std::map<std::string, Value>& values,
                const std::map<std::string, Value>& alike, std::vector<std::string>* fields) {
  for (const auto& [name, value] : values) {
    const auto kept = alike.find(name);
    if (kept == alike.end() || !(kept->second == value)) fields->push_back(Keyed(field, name));
  }
}

}  // namespace

BodyRequest WithSidesAlike(BodyRequest request) {
  const Model human = WholeHuman();
  KeepAlike(&request.segment_lengths);
  KeepAlike(&request.changes.foot_semi_axes);
  KeepAlike(&request.changes.foot_exponents);
  KeepAlike(&request.changes.loads);
  KeepAlike(
      human, [](double share, double) { return share; }, &request.changes.strengths);
  const auto rests = [](const JointSpring& spring, double sign) {
    return JointSpring{spring.stiffness, sign * spring.rest, spring.damping};
  };
  KeepAlike(human, rests, &request.changes.springs);
  KeepAlike(
      human, [](double angle, double sign) { return sign * angle; }, &request.locked_joints);
  return request;
}

std::vector<std::string> OneSidedFields(const BodyRequest& request) {
  if (request.own) return {"own"};
  const BodyRequest alike = WithSidesAlike(request);
  std::vector<std::string> fields;
  AddChanged("segment_lengths_m", request.segment_lengths, alike.segment_lengths, &fields);
  AddChanged("locked_joints_rad", request.locked_joints, alike.locked_joints, &fields);
  AddChanged("foot_semi_axes_m", request.changes.foot_semi_axes, alike.changes.foot_semi_axes, &fields);
  AddChanged("foot_exponents", request.changes.foot_exponents, alike.changes.foot_exponents, &fields);
  AddChanged("joint_strengths", request.changes.strengths, alike.changes.strengths, &fields);
  AddChanged("joint_springs", request.changes.springs, alike.changes.springs, &fields);
  const std::vector<char> have = HaveImages(request.changes.loads);
  for (size_t i = 0; i < have.size(); ++i) {
    if (!have[i]) fields.push_back("loads[" + std::to_string(i) + "]");
  }
  return fields;
}

}  // namespace rollgait
