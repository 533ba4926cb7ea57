#include "core/models/sides_alike.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

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

void KeepAlike(std::map<std::string, double>* lengths) {
  const std::map<std::string, double> given = *lengths;
  for (const auto& [name, length] : given) {
    const auto other = given.find(MirrorNameOf(*FindSegment(name)));
    if (other == given.end() || other->second != length) lengths->erase(name);
  }
}

bool AreMirrored(const SegmentLoad& load, const SegmentLoad& other) {
  SegmentLoad image = other;
  if (image.position) image.position->z() *= -1;
  return load.segment == MirrorNameOf(*FindSegment(other.segment)) && load.mass == image.mass &&
         load.position == image.position && load.moments == image.moments;
}

void KeepAlike(std::vector<SegmentLoad>* loads) {
  std::vector<char> kept(loads->size(), 0);
  for (size_t i = 0; i < loads->size(); ++i) {
    SegmentLoad& load = (*loads)[i];
    if (FindSegment(load.segment)->side == BodySide::kMidline) {
      if (load.position) load.position->z() = 0;
      kept[i] = 1;
    }
    for (size_t k = i + 1; k < loads->size() && !kept[i]; ++k) {
      if (!kept[k] && AreMirrored(load, (*loads)[k])) kept[i] = kept[k] = 1;
    }
  }
  std::vector<SegmentLoad> alike;
  for (size_t i = 0; i < loads->size(); ++i) {
    if (kept[i]) alike.push_back(std::move((*loads)[i]));
  }
  *loads = std::move(alike);
}

}  // namespace

BodyRequest WithSidesAlike(BodyRequest request) {
  const Model human = WholeHuman();
  KeepAlike(&request.segment_lengths);
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

}  // namespace rollgait
