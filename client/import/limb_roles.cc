#include "client/import/limb_roles.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace rollgait::client {
namespace {

using Roles = std::vector<std::pair<const char*, v1::Joint::Role>>;

bool NameHas(const std::string& name, const std::string& word) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.find(word) != std::string::npos;
}

// Gives each role of the list to the first joint whose name has its word.
void ByName(const std::vector<LimbJoint>& joints, const Roles& words, std::vector<LimbRole>* roles) {
  for (const auto& [word, role] : words) {
    for (const LimbJoint& joint : joints) {
      const bool taken = std::any_of(roles->begin(), roles->end(), [&, wanted = role](const LimbRole& other) {
        return other.index == joint.index || other.role == wanted;
      });
      if (taken || !NameHas(joint.name, word)) continue;
      roles->push_back({joint.index, role, std::string("its name has \"") + word + "\", and it turns about y"});
    }
  }
}

std::vector<LimbRole> RolesOfLeg(const std::vector<LimbJoint>& leg) {
  const Roles words = {{"hip", v1::Joint::ROLE_HIP_FLEXION},
                       {"knee", v1::Joint::ROLE_KNEE_FLEXION},
                       {"ankle", v1::Joint::ROLE_ANKLE_DORSIFLEXION}};
  std::vector<LimbRole> roles;
  ByName(leg, words, &roles);
  // Where each named joint is in the leg, so that the others keep the order.
  size_t next = 0;
  for (const auto& [word, role] : words) {
    const auto named =
        std::find_if(roles.begin(), roles.end(), [wanted = role](const LimbRole& r) { return r.role == wanted; });
    if (named != roles.end()) {
      while (next < leg.size() && leg[next].index != named->index) ++next;
      ++next;
      continue;
    }
    const bool free = next < leg.size() && std::none_of(roles.begin(), roles.end(),
                                                        [&](const LimbRole& r) { return r.index == leg[next].index; });
    if (!free) continue;
    roles.push_back({leg[next].index, role, "by its place among the joints of the leg that turn about y"});
    ++next;
  }
  return roles;
}

}  // namespace

std::vector<LimbRole> ProposeRoles(const std::vector<LimbJoint>& joints) {
  std::vector<LimbRole> roles;
  for (const v1::BodySide side : {v1::BODY_SIDE_LEFT, v1::BODY_SIDE_RIGHT, v1::BODY_SIDE_UNSPECIFIED}) {
    std::vector<LimbJoint> leg, rest;
    for (const LimbJoint& joint : joints) {
      if (joint.side == side && joint.across >= 0.5) (joint.in_leg ? leg : rest).push_back(joint);
    }
    std::vector<LimbRole> found = RolesOfLeg(leg);
    roles.insert(roles.end(), found.begin(), found.end());
    found.clear();
    if (side == v1::BODY_SIDE_UNSPECIFIED) {
      Roles words;
      for (const char* word : {"waist", "trunk", "torso", "back", "spine", "lumbar", "abdomen"}) {
        words.emplace_back(word, v1::Joint::ROLE_TRUNK_FLEXION);
      }
      ByName(rest, words, &found);
    } else {
      ByName(rest,
             {{"shoulder", v1::Joint::ROLE_SHOULDER_FLEXION},
              {"arm_flex", v1::Joint::ROLE_SHOULDER_FLEXION},
              {"elbow", v1::Joint::ROLE_ELBOW_FLEXION}},
             &found);
    }
    roles.insert(roles.end(), found.begin(), found.end());
  }
  return roles;
}

}  // namespace rollgait::client
