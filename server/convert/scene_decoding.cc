#include "server/convert/scene_decoding.h"

#include <cmath>

namespace rollgait::server {

SceneDecoding::SceneDecoding(const v1::SimulationScene& message) {
  for (int i = 0; i < message.joints_size(); ++i) joints_.emplace(message.joints(i).name(), i);
  for (int i = 0; i < message.ground_size(); ++i) {
    const std::string& name = message.ground(i).name();
    if (name.empty() || !grounds_.emplace(name, i + 1).second) {
      Refuse("ground[" + std::to_string(i) + "].name", "\"" + name + "\" is empty or used twice; name every frame");
    }
  }
  for (int i = 0; i < message.contacts_size(); ++i) {
    const std::string& name = message.contacts(i).name();
    if (name.empty() || !contacts_.emplace(name, i).second) {
      Refuse("contacts[" + std::to_string(i) + "].name", "\"" + name + "\" is empty or used twice; name every contact");
    }
  }
}

int SceneDecoding::Find(const std::map<std::string, int>& names, const std::string& field, const std::string& name,
                        const char* what) {
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  std::string known;
  for (const auto& [known_name, index] : names) known += (known.empty() ? "" : ", ") + known_name;
  Refuse(field, "\"" + name + "\" is no " + what + " of the scene; it has " + (known.empty() ? "none" : known));
  return 0;
}

Eigen::Quaterniond SceneDecoding::Rotation(const std::string& field, bool given, const v1::Quaternion& q) {
  if (!given) return Eigen::Quaterniond::Identity();
  const Eigen::Quaterniond rotation(q.w(), q.x(), q.y(), q.z());
  const double norm = rotation.norm();
  if (!std::isfinite(norm) || !(norm > 1e-6)) {
    Refuse(field, "must be a finite quaternion w, x, y, z of length above 1e-6 (it is normalised)");
    return Eigen::Quaterniond::Identity();
  }
  return rotation.normalized();
}

Vector3 SceneDecoding::Direction(const std::string& field, bool given, const v1::Vector3& v, const Vector3& otherwise) {
  if (!given) return otherwise;
  const Vector3 direction = DecodeVector(v);
  const double norm = direction.stableNorm();
  if (!std::isfinite(norm) || !(norm > 1e-12)) {
    Refuse(field, "must be a finite vector of length above 1e-12 (it is normalised)");
    return otherwise;
  }
  return direction / norm;
}

Surface SceneDecoding::Shape(const std::string& field, const v1::Surface& surface) {
  return DecodeSurface(field, surface, &violations_).value_or(Sphere(1));
}

Vector3 SceneDecoding::Point(const std::string& field, const v1::Vector3& v) {
  Vector3 point = DecodeVector(v);
  if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kMaxSceneNumber) {
    Refuse(field, "every component must be finite and within ±1e9 m");
    return Vector3::Zero();
  }
  return point;
}

}  // namespace rollgait::server
