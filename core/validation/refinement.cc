#include "core/validation/refinement.h"

#include <cmath>

namespace rollgait {

std::optional<ObservedOrder> ObserveOrder(const std::vector<MeshError>& meshes) {
  if (meshes.size() < 2) return std::nullopt;
  double mean_x = 0, mean_y = 0;
  for (const MeshError& mesh : meshes) {
    if (!(mesh.step > 0 && mesh.error > 0 && std::isfinite(mesh.step) && std::isfinite(mesh.error))) {
      return std::nullopt;
    }
    mean_x += std::log(mesh.step) / static_cast<double>(meshes.size());
    mean_y += std::log(mesh.error) / static_cast<double>(meshes.size());
  }
  ObservedOrder result;
  double xx = 0, xy = 0;
  for (size_t i = 0; i < meshes.size(); ++i) {
    const double x = std::log(meshes[i].step) - mean_x, y = std::log(meshes[i].error) - mean_y;
    xx += x * x;
    xy += x * y;
    if (i == 0) continue;
    if (meshes[i].step == meshes[i - 1].step) return std::nullopt;
    result.between_meshes.push_back(std::log(meshes[i].error / meshes[i - 1].error) /
                                    std::log(meshes[i].step / meshes[i - 1].step));
  }
  result.order = xy / xx;
  return result;
}

}  // namespace rollgait
