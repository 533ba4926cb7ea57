#include "client/report/stride_data.h"

#include <algorithm>
#include <string>
#include <vector>

#include "client/joint_kinds.h"
#include "client/report/kinematics.h"
#include "client/report/packed_rows.h"
#include "client/report/sides.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

std::string Title(const std::string& name) {
  static constexpr std::pair<const char*, const char*> kBase[] = {
      {"base_pitch", "pelvis tilt"}, {"base_roll", "pelvis obliquity"}, {"base_yaw", "pelvis rotation"}};
  for (const auto& [base, title] : kBase) {
    if (name == base) return title;
  }
  std::string title = WithoutSide(name);
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

}  // namespace

json StrideData(const Stride& stride, const v1::Model& model) {
  const std::vector<Side> sides = JointSides(model);
  PackedRows rows(static_cast<int>(stride.samples.size()));
  const auto row = [&](const auto& value) {
    std::vector<double> values;
    for (const StrideSample& sample : stride.samples) values.push_back(value(sample.instant));
    return rows.Add(values);
  };
  json joints = json::array();
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    const bool slide = IsSlide(joint);
    if (slide && !joint.actuated()) continue;
    const double scale = slide ? 1 : 180 / kPi;
    const bool bounded = joint.position_max() - joint.position_min() < 1e6;
    json data = {{"name", joint.name()},
                 {"title", Title(joint.name())},
                 {"side", static_cast<int>(sides[i])},
                 {"unit", slide ? "m" : "degrees"},
                 {"positive", PositiveDirection(model, i)},
                 {"min", bounded ? json(scale * joint.position_min()) : json()},
                 {"max", bounded ? json(scale * joint.position_max()) : json()},
                 {"angle", row([&](const Instant& at) { return scale * at.position[i]; })},
                 {"torque", json()},
                 {"power", json()}};
    if (joint.actuated()) {
      data["torque"] = row([i](const Instant& at) { return at.effort[i]; });
      data["power"] = row([i](const Instant& at) { return at.effort[i] * at.velocity[i]; });
    }
    joints.push_back(std::move(data));
  }
  return {{"duration", stride.duration_s},
          {"displacement", stride.displacement_m},
          {"joints", joints},
          {"curves", rows.ToJson()}};
}

}  // namespace rollgait::client
