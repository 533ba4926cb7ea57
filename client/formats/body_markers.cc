#include "client/formats/body_markers.h"

#include "client/report/kinematics.h"

namespace rollgait::client {

std::vector<BodyMarker> BodyMarkers(const v1::Model& model) {
  constexpr double kDistance_m = 0.1;
  std::vector<BodyMarker> markers;
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& link = model.joints(i);
    if (!(link.mass_kg() > 0)) continue;
    const Eigen::Vector3d center = ToVector(link.center_of_mass_m());
    markers.push_back({link.link_name() + "_joint", i, Eigen::Vector3d::Zero()});
    markers.push_back({link.link_name() + "_front", i, center + kDistance_m * Eigen::Vector3d::UnitX()});
    markers.push_back({link.link_name() + "_left", i, center + kDistance_m * Eigen::Vector3d::UnitY()});
  }
  return markers;
}

}  // namespace rollgait::client
