#include "core/gait/combined_costs.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"
#include "core/gait/presets.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

template <typename Value>
void KeepUnset(const std::optional<Value>& preset, std::optional<Value>* own) {
  if (!*own) *own = preset;
}

void KeepUnset(const std::map<std::string, double>& preset, std::map<std::string, double>* own) {
  if (own->empty()) *own = preset;
}

// Fills what the request's term leaves unset with the parameters of the preset's term of the same kind.
struct ParametersOfPreset {
  const decltype(GaitRequest::CostTerm::term)& preset;

  template <typename Term>
  const Term& Same(const Term&) const {
    const Term* const same = std::get_if<Term>(&preset);
    ROLLGAIT_CHECK(same != nullptr);
    return *same;
  }

  void operator()(GaitRequest::SquaredTorque& own) const { KeepUnset(Same(own).joint_weights, &own.joint_weights); }
  void operator()(GaitRequest::SquaredTorqueRate& own) const { KeepUnset(Same(own).joint_weights, &own.joint_weights); }
  void operator()(GaitRequest::SquaredForceRate&) const {}
  void operator()(GaitRequest::MechanicalWork& own) const { KeepUnset(Same(own).smoothing, &own.smoothing); }
  void operator()(GaitRequest::Time&) const {}
  void operator()(GaitRequest::MuscleEffort& own) const {
    KeepUnset(Same(own).exponent, &own.exponent);
    KeepUnset(Same(own).joint_weights, &own.joint_weights);
  }
  void operator()(GaitRequest::MuscleWork& own) const {
    KeepUnset(Same(own).positive_efficiency, &own.positive_efficiency);
    KeepUnset(Same(own).negative_efficiency, &own.negative_efficiency);
    KeepUnset(Same(own).smoothing, &own.smoothing);
    KeepUnset(Same(own).joint_weights, &own.joint_weights);
  }
  void operator()(GaitRequest::PassiveLoad& own) const { KeepUnset(Same(own).joint_weights, &own.joint_weights); }
  void operator()(GaitRequest::SquaredAcceleration& own) const {
    KeepUnset(Same(own).joint_weights, &own.joint_weights);
  }
  void operator()(GaitRequest::Tracking& own) const {
    if (own.channels.empty()) own.channels = Same(own).channels;
  }
};

}  // namespace

std::vector<CombinedCost> CombineCosts(const GaitRequest& request, const Scene* scene, const Similarity& similarity) {
  std::vector<CombinedCost> combined;
  if (request.preset && scene != nullptr) {
    for (GaitRequest::CostTerm& cost : PresetCosts(*request.preset, *scene, similarity)) {
      combined.push_back({std::move(cost), "preset"});
    }
  }
  for (size_t i = 0; i < request.costs.size(); ++i) {
    GaitRequest::CostTerm own = request.costs[i];
    const auto replaced = std::find_if(combined.begin(), combined.end(), [&own](const CombinedCost& of_preset) {
      return of_preset.field == "preset" && of_preset.cost.term.index() == own.term.index();
    });
    if (replaced == combined.end()) {
      combined.push_back({std::move(own), Indexed("costs", i)});
      continue;
    }
    KeepUnset(replaced->cost.weight, &own.weight);
    std::visit(ParametersOfPreset{replaced->cost.term}, own.term);
    replaced->cost = std::move(own);
    replaced->field = Indexed("costs", i);
  }
  if (combined.empty()) combined.emplace_back().field = Indexed("costs", 0);  // the first kind: squared torque
  return combined;
}

}  // namespace rollgait
