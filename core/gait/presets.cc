#include "core/gait/presets.h"

#include <map>
#include <string>
#include <utility>

#include "core/base/check.h"

namespace rollgait {
namespace {

constexpr double kMass = 75;  // kg, at which the weights are given
constexpr double kGravity = 9.81;

// The weights whose joints the body has; "hip" stands for hip_l and hip_r.
std::map<std::string, double> OfBody(const std::map<std::string, double>& weights, const Scene& scene) {
  std::map<std::string, double> known;
  for (const auto& [name, weight] : weights) {
    for (const char* suffix : {"", "_l", "_r"}) {
      if (scene.model.Find(name + suffix) >= 0) known[name + suffix] = weight;
    }
  }
  return known;
}

// Upright trunk and pelvis.
GaitRequest::Tracking Posture(const Scene& scene) {
  GaitRequest::Tracking posture;
  for (const char* joint : {"base_pitch", "trunk_flexion"}) {
    if (scene.model.Find(joint) >= 0) posture.channels.push_back({joint, {0, 0}, 1.0});
  }
  return posture;
}

class Costs {
 public:
  template <typename Term>
  void Add(Term term, double weight) {
    terms_.emplace_back();
    terms_.back().term = std::move(term);
    terms_.back().weight = weight;
  }
  std::vector<GaitRequest::CostTerm> Take() { return std::move(terms_); }

 private:
  std::vector<GaitRequest::CostTerm> terms_;
};

void AddHumanCosts(const Scene& scene, Costs* costs) {
  const double size = scene.selection.mass / kMass;
  GaitRequest::MuscleEffort effort;
  effort.joint_weights = OfBody({{"hip", 0.5}, {"knee", 0.1}, {"ankle", 0.2}}, scene);
  costs->Add(std::move(effort), 1);
  costs->Add(GaitRequest::MuscleWork{}, 5e-4 / size);
  costs->Add(GaitRequest::PassiveLoad{}, 1.2);
  costs->Add(GaitRequest::SquaredTorqueRate{}, 2e-8 / (size * size));
  GaitRequest::SquaredAcceleration acceleration;
  acceleration.joint_weights =
      OfBody({{"hip", 0.6}, {"knee", 0.3}, {"ankle", 2.7}, {"base_pitch", 1.6}, {"base_z", 0.7}}, scene);
  costs->Add(std::move(acceleration), 2.7e-6);
  GaitRequest::Tracking posture = Posture(scene);
  if (!posture.channels.empty()) costs->Add(std::move(posture), 0.5);
}

}  // namespace

void FillFromPreset(GaitRequest* request) {
  if (request->preset != Preset::kHuman) return;
  if (!request->body.feet) request->body.feet = FootShape::kTwoEllipsoids;
  if (!request->phases && !request->motion.duty_factor) request->motion.duty_factor = GaitRequest::Range{0.605, 0.615};
  if (!request->ground_contact.swing_clearance) request->ground_contact.swing_clearance = 0.02;
}

std::vector<GaitRequest::CostTerm> PresetCosts(Preset preset, const Scene& scene) {
  const double size = scene.selection.mass / kMass;
  Costs costs;
  switch (preset) {
    case Preset::kTorque:
      costs.Add(GaitRequest::SquaredTorque{}, 1);
      return costs.Take();
    case Preset::kTransport:
      costs.Add(GaitRequest::MuscleWork{}, 1 / (scene.selection.mass * kGravity));
      // Work alone leaves efforts undetermined, and on coarse meshes pays for energy that is none.
      costs.Add(GaitRequest::SquaredTorqueRate{}, 3e-8 / (size * size));
      costs.Add(GaitRequest::SquaredAcceleration{}, 3e-6);
      costs.Add(GaitRequest::MuscleEffort{}, 0.05);
      return costs.Take();
    case Preset::kHuman:
      AddHumanCosts(scene, &costs);
      return costs.Take();
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace rollgait
