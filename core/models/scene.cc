#include "core/models/scene.h"

namespace rollgait {

int Scene::FindContact(const std::string& contact_name) const {
  for (size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].name == contact_name) return static_cast<int>(i);
  }
  return -1;
}

int Scene::FindContact(BodySide side, FootPart part) const {
  for (size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].side == side && contacts[i].part == part) return static_cast<int>(i);
  }
  return -1;
}

std::string Scene::PairName(int pair) const {
  return bodies[pairs[pair].first].name + " / " + bodies[pairs[pair].second].name;
}

}  // namespace rollgait
