#include "core/gait/presets.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/base/check.h"

namespace rollgait {
namespace {

constexpr double kGravity = 9.81;  // m/s², at which weights are given, with 75 kg

// The weights by name of the joints that have these roles, on either side.
std::map<std::string, double> OfBody(const std::map<JointRole, double>& weights, const Scene& scene) {
  std::map<std::string, double> named;
  for (const Joint& joint : scene.model.joints()) {
    const auto weight = weights.find(joint.role);
    if (weight != weights.end()) named[joint.name] = weight->second;
  }
  return named;
}

// Upright trunk and pelvis.
cost::Tracking Posture(const Scene& scene) {
  cost::Tracking posture;
  for (const JointRole role : {JointRole::kBasePitch, JointRole::kTrunkFlexion}) {
    const int joint = scene.model.Find(role);
    if (joint >= 0) posture.channels.push_back({scene.model.joint(joint).name, {0, 0}, 1.0});
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

// Factors on weights that undo what mass and gravity do to the integral of a term, ∫ … dt with dt in proportion to
// 1/√g.
struct WeightFactors {
  explicit WeightFactors(const Similarity& s)
      : ratio(s.speed()),
        energy(s.speed() / s.power()),
        torque_rate(s.speed() / std::pow(s.power(), 2)),
        acceleration(s.speed() / std::pow(s.gravity, 2)) {}
  double ratio;         // of what neither changes: torque over strength, angles
  double energy;        // of powers
  double torque_rate;   // of its square; a rate of torque has the factor of a power
  double acceleration;  // of its square
};

void AddHumanCosts(const Scene& scene, const WeightFactors& factors, Costs* costs) {
  cost::MuscleEffort effort;
  effort.joint_weights = OfBody(
      {{JointRole::kHipFlexion, 0.5}, {JointRole::kKneeFlexion, 0.1}, {JointRole::kAnkleDorsiflexion, 0.2}}, scene);
  std::erase_if(effort.joint_weights,  // of a joint without muscles nothing is known
                [&](const auto& named) { return !scene.model.joint(scene.model.Find(named.first)).actuated; });
  costs->Add(std::move(effort), factors.ratio);
  costs->Add(cost::MuscleWork{}, 5e-4 * factors.energy);
  costs->Add(cost::PassiveLoad{}, 1.2 * factors.ratio);
  costs->Add(cost::SquaredTorqueRate{}, 2e-8 * factors.torque_rate);
  cost::SquaredAcceleration acceleration;
  acceleration.joint_weights = OfBody({{JointRole::kHipFlexion, 0.6},
                                       {JointRole::kKneeFlexion, 0.3},
                                       {JointRole::kAnkleDorsiflexion, 2.7},
                                       {JointRole::kBasePitch, 1.6},
                                       {JointRole::kBaseVertical, 0.7}},
                                      scene);
  costs->Add(std::move(acceleration), 2.7e-6 * factors.acceleration);
  cost::Tracking posture = Posture(scene);
  if (!posture.channels.empty()) costs->Add(std::move(posture), 0.5 * factors.ratio);
}

}  // namespace

void FillFromPreset(GaitRequest* request) {
  if (request->preset != Preset::kHuman) return;
  if (!request->body.feet && !request->body.own) request->body.feet = FootShape::kTwoEllipsoids;
  if (!request->phases && !request->motion.duty_factor) request->motion.duty_factor = GaitRequest::Range{0.605, 0.615};
  if (!request->ground_contact.swing_clearance) request->ground_contact.swing_clearance = 0.02;
}

std::vector<GaitRequest::CostTerm> PresetCosts(Preset preset, const Scene& scene, const Similarity& similarity) {
  const WeightFactors factors(similarity);
  Costs costs;
  switch (preset) {
    case Preset::kTorque:
      costs.Add(cost::SquaredTorque{}, 1);
      return costs.Take();
    case Preset::kTransport:
      costs.Add(cost::MuscleWork{}, 1 / (scene.selection.mass * kGravity * similarity.gravity));
      // Work alone leaves efforts undetermined, and on coarse meshes pays for energy that is none.
      costs.Add(cost::SquaredTorqueRate{}, 3e-8 * factors.torque_rate);
      costs.Add(cost::SquaredAcceleration{}, 3e-6 * factors.acceleration);
      costs.Add(cost::MuscleEffort{}, 0.05 * factors.ratio);
      return costs.Take();
    case Preset::kHuman:
      AddHumanCosts(scene, factors, &costs);
      return costs.Take();
  }
  ROLLGAIT_CHECK(false);
}

void ScaleLimits(const Similarity& similarity, std::vector<Joint>* joints) {
  for (Joint& joint : *joints) {
    joint.velocity_max *= similarity.speed();
    joint.effort_min *= similarity.gravity;
    joint.effort_max *= similarity.gravity;
  }
}

}  // namespace rollgait
