#ifndef ROLLGAIT_SERVER_CONVERT_SCENE_DECODING_H_
#define ROLLGAIT_SERVER_CONVERT_SCENE_DECODING_H_

#include <Eigen/Geometry>
#include <map>
#include <string>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/simulation/scene.h"
#include "rollgait/v1/simulation.pb.h"
#include "server/convert/surface_convert.h"

namespace rollgait::server {

inline Vector3 DecodeVector(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

// What the parts of a scene's decoding share: the names of the scene, and what was found wrong so far. A value that is
// refused is replaced by a valid one, so that decoding goes on and finds the rest.
class SceneDecoding {
 public:
  explicit SceneDecoding(const v1::SimulationScene& scene);

  void Refuse(const std::string& field, const std::string& message) { violations_.push_back({field, message}); }
  const Violations& violations() const { return violations_; }

  // Indices by name; ground frame 0 is the world, which has none.
  int Joint(const std::string& field, const std::string& name) { return Find(joints_, field, name, "joint"); }
  int Ground(const std::string& field, const std::string& name) { return Find(grounds_, field, name, "ground frame"); }
  int Contact(const std::string& field, const std::string& name) { return Find(contacts_, field, name, "contact"); }

  // Not given: the identity.
  Eigen::Quaterniond Rotation(const std::string& field, bool given, const v1::Quaternion& q);
  Surface Shape(const std::string& field, const v1::Surface& surface);
  // Of unit length.
  Vector3 Direction(const std::string& field, bool given, const v1::Vector3& v, const Vector3& otherwise);
  Vector3 Point(const std::string& field, const v1::Vector3& v);

 private:
  int Find(const std::map<std::string, int>& names, const std::string& field, const std::string& name,
           const char* what);

  std::map<std::string, int> joints_, grounds_, contacts_;
  Violations violations_;
};

// Contact k of the scene.
SceneContact DecodeContact(const v1::SceneContact& contact, int k, SceneDecoding* decoding);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_SCENE_DECODING_H_
