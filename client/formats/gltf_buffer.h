// The binary buffer of a glTF file with its views and accessors.
#ifndef ROLLGAIT_CLIENT_FORMATS_GLTF_BUFFER_H_
#define ROLLGAIT_CLIENT_FORMATS_GLTF_BUFFER_H_

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rollgait::client {

class GltfBuffer {
 public:
  // Single precision numbers, `components` of them an element: 1, 3 or 4. Returns the index of the accessor.
  // `vertices`: for a mesh, not for an animation. Contract: a whole number of elements, at least one.
  int AddFloats(const std::vector<double>& values, int components, bool vertices = false);
  // Corners of triangles. Contract: at least one, each < 65536.
  int AddIndices(const std::vector<int>& indices);

  const std::string& bytes() const { return bytes_; }  // a multiple of four
  const nlohmann::json& views() const { return views_; }
  const nlohmann::json& accessors() const { return accessors_; }

 private:
  void AddView(size_t start, int target);

  std::string bytes_;
  nlohmann::json views_ = nlohmann::json::array(), accessors_ = nlohmann::json::array();
};

// Four bytes, the lowest first.
std::string LittleEndian(uint32_t value);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_GLTF_BUFFER_H_
