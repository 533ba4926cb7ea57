#include "client/import/osim_frames.h"

#include <algorithm>
#include <sstream>

#include "client/import/lumped_links.h"

namespace rollgait::client {
namespace {

constexpr int kMostFrames = 8;  // within each other

std::vector<std::string> PartsOf(const std::string& path) {
  std::istringstream text(path);
  std::vector<std::string> parts;
  for (std::string part; std::getline(text, part, '/');) {
    if (!part.empty() && part != "." && part != "..") parts.push_back(part);
  }
  return parts;
}

}  // namespace

void OsimFrames::AddBody(const OsimElement& body, const std::string& name, int link) {
  bodies_.emplace(name, link);
  for (const OsimElement& component : body.Objects("components")) {
    if (component.Kind() != "PhysicalOffsetFrame") continue;
    components_.emplace(name + "/" + component.Name(), OsimPlace{link, component.Place()});
  }
}

OsimPlace OsimFrames::Find(const OsimElement& user, const std::string& path, const std::vector<OsimElement>& own,
                           int depth) const {
  const std::vector<std::string> parts = PartsOf(path);
  if (parts.empty()) user.Refuse("needs the path of a frame");
  user.source().RequireName(user.xml(), "the path of its frame", path);
  const std::string shown = "\"" + path + "\"";
  if (depth > kMostFrames) user.Refuse("the frame " + shown + " is in more than 8 others, or in itself");
  if (parts.size() >= 2) {
    const auto component = components_.find(parts[parts.size() - 2] + "/" + parts.back());
    if (component != components_.end()) return component->second;
  }
  const auto body = bodies_.find(parts.back());
  const bool is_path = path[0] == '/';
  if (is_path && body != bodies_.end()) return {body->second};
  for (const OsimElement& frame : own) {
    if (frame.Kind() != "PhysicalOffsetFrame" || frame.Name() != parts.back()) continue;
    OsimPlace place = Find(frame, frame.Text("socket_parent"), own, depth + 1);
    place.pose = Compose(place.pose, frame.Place());
    return place;
  }
  if (body != bodies_.end()) return {body->second};
  user.Refuse("the frame " + shown + " is neither the ground nor a body of the file, nor fixed to one");
}

}  // namespace rollgait::client
