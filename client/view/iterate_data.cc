#include "client/view/iterate_data.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "client/failure.h"
#include "client/report/scene_data.h"

namespace rollgait::client {
namespace {

constexpr int kSteps = 100;  // of the cycle; even: SceneData wants an odd number of instants

void RequireFit(bool condition, const std::string& what) {
  if (!condition) throw Failure(ExitCode::kUsage, "the iterate does not fit its model: " + what);
}

// For each column of the iterate its joint in the model.
std::vector<int> JointsOf(const v1::Iterate& iterate, const v1::Model& model) {
  std::vector<int> joints;
  for (const std::string& name : iterate.joint_names()) {
    const auto joint = std::find_if(model.joints().begin(), model.joints().end(),
                                    [&name](const v1::Joint& candidate) { return candidate.name() == name; });
    RequireFit(joint != model.joints().end(), "joint_names has \"" + name + "\", which is not a joint of the model");
    joints.push_back(static_cast<int>(joint - model.joints().begin()));
  }
  RequireFit(static_cast<int>(joints.size()) == model.joints_size(), "joint_names must name every joint of the model");
  return joints;
}

void RequireWhole(const v1::Iterate& iterate) {
  RequireFit(iterate.phases_size() > 0, "phases is empty");
  RequireFit(std::isfinite(iterate.duration_s()) && iterate.duration_s() > 0, "duration_s must be > 0");
  RequireFit(std::isfinite(iterate.displacement_m()), "displacement_m must be finite");
  for (int p = 0; p < iterate.phases_size(); ++p) {
    const v1::Iterate::Phase& phase = iterate.phases(p);
    const std::string path = "phases[" + std::to_string(p) + "].";
    RequireFit(phase.times_s_size() >= 2, path + "times_s must have at least 2 values");
    const int64_t values = int64_t{phase.times_s_size()} * iterate.joint_names_size();
    RequireFit(phase.positions_size() == values, path + "positions must have " + std::to_string(values) + " values");
  }
}

// Of each phase, which contacts of the model it has.
std::vector<std::vector<bool>> ActiveContacts(const v1::Iterate& iterate, const v1::Model& model) {
  std::vector<std::vector<bool>> active;
  for (const v1::Iterate::Phase& phase : iterate.phases()) {
    std::vector<bool>& row = active.emplace_back();
    for (const v1::ContactSurface& contact : model.contacts()) {
      row.push_back(std::find(phase.contacts().begin(), phase.contacts().end(), contact.name()) !=
                    phase.contacts().end());
    }
  }
  return active;
}

}  // namespace

StrideSource IterateMotion(const v1::Iterate& iterate, const v1::Model& model) {
  RequireWhole(iterate);
  const auto at = [&iterate, joints = JointsOf(iterate, model), active = ActiveContacts(iterate, model)](
                      double time_s, bool from_left) {
    const double slack = (from_left ? -1e-6 : 1e-6) * iterate.duration_s();  // the times are floats
    int p = 0;
    while (p + 1 < iterate.phases_size() && time_s + slack >= iterate.phases(p + 1).start_s()) ++p;
    const v1::Iterate::Phase& phase = iterate.phases(p);
    int k = 0;
    while (k + 2 < phase.times_s_size() && time_s >= phase.times_s(k + 1)) ++k;
    const double length = phase.times_s(k + 1) - phase.times_s(k);
    const double share = length > 0 ? std::clamp((time_s - phase.times_s(k)) / length, 0.0, 1.0) : 0;
    const size_t n = joints.size();
    Instant instant;
    instant.position.resize(n);
    instant.velocity.assign(n, 0);
    instant.effort.assign(n, 0);
    instant.active = active[p];
    instant.force.assign(active[p].size(), {0, 0, 0});
    for (size_t j = 0; j < n; ++j) {
      const double before = phase.positions(static_cast<int>(k * n + j));
      const double after = phase.positions(static_cast<int>((k + 1) * n + j));
      instant.position[joints[j]] = before + share * (after - before);
    }
    return instant;
  };
  return {iterate.duration_s(), iterate.displacement_m(), iterate.cycle() == v1::CYCLE_HALF, at};
}

nlohmann::json IterateData(const v1::Iterate& iterate, const v1::Model& model) {
  const Stride stride = BuildStride(IterateMotion(iterate, model), model, 0, kSteps);
  std::vector<Instant> instants;
  for (const StrideSample& sample : stride.samples) instants.push_back(sample.instant);
  return {{"index", iterate.index()},
          {"mesh", iterate.mesh()},
          {"stride",
           {{"duration", stride.duration_s},
            {"displacement", stride.displacement_m},
            {"phases", nlohmann::json::array()},
            {"feet", nlohmann::json::array()},
            {"events", nlohmann::json::array()},
            {"scene", SceneData(instants, model, {})}}}};
}

}  // namespace rollgait::client
