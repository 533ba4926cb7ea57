#include "core/gait/combined_costs.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"
#include "core/gait/presets.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

void KeepUnset(const std::optional<double>& preset, std::optional<double>* own) {
  if (!*own) *own = preset;
}

// Fills what the request's term leaves unset with the parameters of the preset's term of the same kind.
struct ParametersOfPreset {
  const cost::Term& preset;

  template <typename Term>
  void operator()(Term& own) const {
    const Term* const same = std::get_if<Term>(&preset);
    ROLLGAIT_CHECK(same != nullptr);
    RowOf<Term>().ForEachParameter(
        [&](const CostParameter<Term>& parameter) { KeepUnset(same->*parameter.member, &(own.*parameter.member)); });
    if constexpr (HasJointWeights<Term>) {
      if (own.joint_weights.empty()) own.joint_weights = same->joint_weights;
    }
    if constexpr (HasChannels<Term>) {
      if (own.channels.empty()) own.channels = same->channels;
    }
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
