#include <set>

#include "core/gait/combined_costs.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

const NumberLimits kWeightLimits{0, kMaxWeight};

using Weights = std::map<std::string, double>;

// The weights of all actuated joints: those given, 1 for the rest.
Weights CheckWeights(const std::string& path, const Weights& weights, const Scene* scene, RequestCheck& check) {
  Weights completed;
  if (scene != nullptr) {
    for (int joint : scene->model.actuated()) completed[scene->model.joint(joint).name] = 1;
  }
  for (const auto& [joint, weight] : weights) {
    const std::string field = Keyed(path, joint);
    check.Number(field, weight, 1, kWeightLimits);
    if (scene == nullptr || check.Joint(field, joint, *scene, true) >= 0) completed[joint] = weight;
  }
  return completed;
}

// Checks one term and fills its optionals.
struct TermCheck {
  std::string path;
  const Scene* scene;
  const Similarity& similarity;
  RequestCheck& check;

  double DefaultSmoothing() const { return 5 * similarity.power(); }  // W

  void operator()(GaitRequest::SquaredTorque& term) const {
    term.joint_weights = CheckWeights(path + ".squared_torque.joint_weights", term.joint_weights, scene, check);
  }

  void operator()(GaitRequest::SquaredTorqueRate& term) const {
    term.joint_weights = CheckWeights(path + ".squared_torque_rate.joint_weights", term.joint_weights, scene, check);
  }

  void operator()(GaitRequest::MechanicalWork& term) const {
    term.smoothing =
        check.Number(path + ".mechanical_work.smoothing_w", term.smoothing, DefaultSmoothing(), {0.01, 1000, "W"});
  }

  void operator()(GaitRequest::SquaredForceRate&) const {}

  void operator()(GaitRequest::Time&) const {}

  void operator()(GaitRequest::Tracking& term) const {
    const std::string channels = path + ".tracking.channels";
    if (term.channels.empty()) check.Add(channels, "no channel; give at least one joint with its positions");
    std::set<std::string> seen;
    for (size_t i = 0; i < term.channels.size(); ++i) {
      const std::string field = Indexed(channels, i);
      CheckChannel(field, term.channels[i]);
      if (!seen.insert(term.channels[i].joint).second) {
        check.Add(field + ".joint",
                  "joint " + Quoted(term.channels[i].joint) + " is tracked twice; give one channel a joint");
      }
    }
  }

  void operator()(GaitRequest::MuscleEffort& term) const {
    const std::string field = path + ".muscle_effort";
    term.exponent = check.Number(field + ".exponent", term.exponent, 2, {2, 10});
    term.joint_weights = CheckWeights(field + ".joint_weights", term.joint_weights, scene, check);
  }

  void operator()(GaitRequest::MuscleWork& term) const {
    const std::string field = path + ".muscle_work";
    const NumberLimits efficiency{0.01, 100};
    term.positive_efficiency = check.Number(field + ".positive_efficiency", term.positive_efficiency, 0.25, efficiency);
    term.negative_efficiency = check.Number(field + ".negative_efficiency", term.negative_efficiency, 1.2, efficiency);
    term.smoothing = check.Number(field + ".smoothing_w", term.smoothing, DefaultSmoothing(), {0.01, 1000, "W"});
    term.joint_weights = CheckWeights(field + ".joint_weights", term.joint_weights, scene, check);
  }

  void operator()(GaitRequest::PassiveLoad& term) const {
    term.joint_weights = CheckWeights(path + ".passive_load.joint_weights", term.joint_weights, scene, check);
  }

  // Of every joint, the base too; those that are not named have weight 1, of the base 0.
  void operator()(GaitRequest::SquaredAcceleration& term) const {
    const std::string field = path + ".squared_acceleration.joint_weights";
    Weights completed;
    if (scene != nullptr) {
      for (int joint : scene->model.actuated()) completed[scene->model.joint(joint).name] = 1;
    }
    for (const auto& [joint, weight] : term.joint_weights) {
      check.Number(Keyed(field, joint), weight, 1, kWeightLimits);
      if (scene == nullptr || check.Joint(Keyed(field, joint), joint, *scene, false) >= 0) completed[joint] = weight;
    }
    term.joint_weights = completed;
  }

  void CheckChannel(const std::string& field, GaitRequest::Tracking::Channel& channel) const {
    if (scene != nullptr) check.Joint(field + ".joint", channel.joint, *scene, false);
    channel.weight = check.Number(field + ".weight", channel.weight, 1, kWeightLimits);
    const size_t count = channel.positions.size();
    if (count < 2 || count > static_cast<size_t>(kMaxTrackedPositions)) {
      check.Add(field + ".positions", std::to_string(count) + " positions; give 2 to " +
                                          std::to_string(kMaxTrackedPositions) + ", equally spaced over the cycle");
      return;
    }
    for (size_t i = 0; i < count; ++i) {
      check.Number(Indexed(field + ".positions", i), channel.positions[i], 0,
                   {-kMaxPosition, kMaxPosition, "rad or m"});
    }
  }
};

}  // namespace

std::vector<GaitSpec::CostTerm> CheckCosts(const GaitRequest& request, const Scene* scene, const Similarity& similarity,
                                           RequestCheck& check) {
  std::vector<CombinedCost> terms = CombineCosts(request, scene, similarity);
  if (terms.size() > static_cast<size_t>(kMaxCostTerms)) {
    check.Add("costs", std::to_string(terms.size()) + " terms" +
                           (request.preset ? ", those of the preset included" : "") + "; at most " +
                           std::to_string(kMaxCostTerms) + " are accepted");
    return {};
  }
  std::vector<GaitSpec::CostTerm> checked;
  for (auto& [cost, field] : terms) {
    double weight = cost.weight.value_or(1);
    if (field != "preset") {
      check.Number(field + ".weight", cost.weight, 1, kWeightLimits);
    } else if (!(weight >= 0 && weight <= kMaxWeight)) {
      check.Add(field, "its weights follow from the mass of the body and gravity, and one of them comes to " +
                           FormatNumber(weight) + ", outside [0, " + FormatNumber(kMaxWeight) +
                           "]; give other masses or another gravity");
    }
    std::visit(TermCheck{field, scene, similarity, check}, cost.term);
    checked.push_back({std::move(cost.term), weight});
  }
  return checked;
}

}  // namespace rollgait
