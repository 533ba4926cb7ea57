#include "client/report/model_data.h"

#include <string>
#include <vector>

#include "client/joint_kinds.h"
#include "client/report/sides.h"
#include "client/report/surface_shape.h"
#include "client/text.h"

namespace rollgait::client {

nlohmann::json ModelData(const v1::Model& model) {
  nlohmann::json joints = nlohmann::json::array();
  for (const v1::Joint& joint : model.joints()) {
    const bool angle = !IsSlide(joint);
    const double scale = angle ? 180 / kPi : 1;
    const bool bounded = joint.position_max() - joint.position_min() < 1e6;
    joints.push_back(
        {{"name", joint.name()},
         {"link", joint.link_name()},
         {"mass", joint.mass_kg()},
         {"iyy", joint.inertia_kg_m2_size() == 6 ? nlohmann::json(joint.inertia_kg_m2(1)) : nlohmann::json()},
         {"angle", angle},
         {"min", bounded ? nlohmann::json(joint.position_min() * scale) : nlohmann::json()},
         {"max", bounded ? nlohmann::json(joint.position_max() * scale) : nlohmann::json()},
         {"effort", joint.actuated() ? nlohmann::json(joint.effort_max()) : nlohmann::json()}});
  }
  nlohmann::json contacts = nlohmann::json::array();
  for (const v1::ContactSurface& contact : model.contacts()) {
    const SurfaceShape shape = ShapeOf(contact.surface());
    const Eigen::Vector3d& axes = shape.semi_axes;
    contacts.push_back({{"name", contact.name()}, {"semi_axes", {axes.x(), axes.y(), axes.z()}}});
    if (!shape.numbers.empty()) contacts.back()["numbers"] = shape.numbers;
  }
  return {{"name", model.summary().name()},
          {"description", model.summary().description()},
          {"mass", model.total_mass_kg()},
          {"stature", model.stature_m()},
          {"leg_length", model.leg_length_m()},
          {"one_sided", IsOneSided(model)},
          {"gravity", model.gravity_m_s2()},
          {"joints", joints},
          {"contacts", contacts},
          {"sources", std::vector<std::string>(model.sources().begin(), model.sources().end())}};
}

}  // namespace rollgait::client
