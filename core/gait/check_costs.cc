#include <set>

#include "core/gait/combined_costs.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

const NumberLimits kWeightLimits{0, kMaxWeight};

// The weights of all actuated joints: those given, 1 for the rest. And those given of other joints, if they may be
// weighted.
JointWeights CheckWeights(const std::string& path, const JointWeights& weights, WeightedJoints weighted,
                          const Scene* scene, RequestCheck& check) {
  JointWeights completed;
  if (scene != nullptr) {
    for (int joint : scene->model.actuated()) completed[scene->model.joint(joint).name] = 1;
  }
  for (const auto& [joint, weight] : weights) {
    const std::string field = Keyed(path, joint);
    check.Number(field, weight, 1, kWeightLimits);
    const bool must_be_actuated = weighted == WeightedJoints::kActuated;
    if (scene == nullptr || check.Joint(field, joint, *scene, must_be_actuated) >= 0) completed[joint] = weight;
  }
  return completed;
}

// Checks one term and fills its optionals, by its row of the table.
struct TermCheck {
  std::string path;
  const Scene* scene;
  const Similarity& similarity;
  RequestCheck& check;

  template <typename Term>
  void operator()(Term& term) const {
    const CostRow<Term>& row = RowOf<Term>();
    const std::string field = path + "." + row.traits.field;
    row.ForEachParameter([&](const CostParameter<Term>& parameter) {
      const double fallback = parameter.is_smoothing ? parameter.fallback * similarity.power() : parameter.fallback;
      std::optional<double>& value = term.*parameter.member;
      value =
          check.Number(field + "." + parameter.field, value, fallback, {parameter.min, parameter.max, parameter.unit});
    });
    if constexpr (HasJointWeights<Term>) {
      term.joint_weights =
          CheckWeights(field + ".joint_weights", term.joint_weights, row.traits.weighted, scene, check);
    }
    if constexpr (HasChannels<Term>) CheckChannels(field + ".channels", term.channels);
  }

  void CheckChannels(const std::string& path_of_all, std::vector<cost::Tracking::Channel>& channels) const {
    if (channels.empty()) check.Add(path_of_all, "no channel; give at least one joint with its positions");
    std::set<std::string> seen;
    for (size_t i = 0; i < channels.size(); ++i) {
      const std::string field = Indexed(path_of_all, i);
      CheckChannel(field, channels[i]);
      if (!seen.insert(channels[i].joint).second) {
        check.Add(field + ".joint",
                  "joint " + Quoted(channels[i].joint) + " is tracked twice; give one channel a joint");
      }
    }
  }

  void CheckChannel(const std::string& field, cost::Tracking::Channel& channel) const {
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
