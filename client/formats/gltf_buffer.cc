#include "client/formats/gltf_buffer.h"

#include <algorithm>
#include <bit>

namespace rollgait::client {
namespace {

// Of the specification: componentType, target of a view.
constexpr int kUnsignedShort = 5123, kFloat = 5126, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

}  // namespace

int GltfBuffer::AddFloats(const std::vector<double>& values, int components, bool vertices) {
  const size_t start = bytes_.size();
  std::vector<float> least(components, INFINITY), largest(components, -INFINITY);
  for (size_t i = 0; i < values.size(); ++i) {
    const float value = static_cast<float>(values[i]);
    bytes_ += LittleEndian(std::bit_cast<uint32_t>(value));
    least[i % components] = std::min(least[i % components], value);
    largest[i % components] = std::max(largest[i % components], value);
  }
  AddView(start, vertices ? kArrayBuffer : 0);
  accessors_.push_back({{"bufferView", views_.size() - 1},
                        {"componentType", kFloat},
                        {"count", values.size() / components},
                        {"type", components == 1   ? "SCALAR"
                                 : components == 3 ? "VEC3"
                                                   : "VEC4"},
                        {"min", least},
                        {"max", largest}});
  return static_cast<int>(accessors_.size()) - 1;
}

int GltfBuffer::AddIndices(const std::vector<int>& indices) {
  const size_t start = bytes_.size();
  for (const int index : indices) bytes_ += LittleEndian(static_cast<uint32_t>(index)).substr(0, 2);
  AddView(start, kElementArrayBuffer);
  accessors_.push_back({{"bufferView", views_.size() - 1},
                        {"componentType", kUnsignedShort},
                        {"count", indices.size()},
                        {"type", "SCALAR"}});
  return static_cast<int>(accessors_.size()) - 1;
}

void GltfBuffer::AddView(size_t start, int target) {
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes_.size() - start}};
  if (target != 0) view["target"] = target;
  views_.push_back(view);
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
}

std::string LittleEndian(uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

}  // namespace rollgait::client
