#ifndef ROLLGAIT_CORE_OCP_COST_TABLE_H_
#define ROLLGAIT_CORE_OCP_COST_TABLE_H_

#include <tuple>
#include <variant>

#include "core/ocp/cost_traits.h"
#include "core/ocp/costs/angular_momentum.h"
#include "core/ocp/costs/muscle_costs.h"
#include "core/ocp/costs/point_costs.h"
#include "core/ocp/costs/rate_costs.h"
#include "core/ocp/costs/tracking_cost.h"

namespace rollgait {

// The row of a smoothing: its member, in W.
template <typename Term>
constexpr CostParameter<Term> Smoothing(std::optional<double> Term::*member) {
  return {member, "smoothing_w", 5, 0.01, 1000, "W", true};
}

// Every kind of cost term, one row each. Conversion, checks, defaults, presets, units and results follow from it; the
// integrand is made by Make(term, context), beside the term's struct in core/ocp/costs/. A term that is not set is of
// the first kind.
inline constexpr std::tuple kCostTable{
    CostRow<cost::SquaredTorque>{{"squared_torque", "squared torque", "N² m² s", 2, -4}},
    CostRow<cost::SquaredTorqueRate>{
        {"squared_torque_rate", "squared torque rate", "N² m²/s", 2, -6, WeightedJoints::kActuated, true}},
    CostRow<cost::MechanicalWork>{{"mechanical_work", "mechanical work", "J", 1, -3},
                                  {Smoothing(&cost::MechanicalWork::smoothing)}},
    CostRow<cost::Time>{{"time", "time", "s"}},
    CostRow<cost::Tracking>{{"tracking", "tracking", "rad² s"}},
    CostRow<cost::MuscleEffort>{{"muscle_effort", "muscle effort", "s"},
                                {{&cost::MuscleEffort::exponent, "exponent", 2, 2, 10}}},
    CostRow<cost::MuscleWork>{{"muscle_work", "muscle work", "J", 1, -3},
                              {{&cost::MuscleWork::positive_efficiency, "positive_efficiency", 0.25, 0.01, 100},
                               {&cost::MuscleWork::negative_efficiency, "negative_efficiency", 1.2, 0.01, 100},
                               Smoothing(&cost::MuscleWork::smoothing)}},
    CostRow<cost::PassiveLoad>{{"passive_load", "passive load", "s"}},
    CostRow<cost::SquaredAcceleration>{
        {"squared_acceleration", "squared acceleration", "rad²/s³", 0, -4, WeightedJoints::kAll}},
    CostRow<cost::SquaredForceRate>{
        {"squared_force_rate", "squared force rate", "N²/s", 2, -6, WeightedJoints::kActuated, true}},
    CostRow<cost::SquaredAngularMomentum>{{"squared_angular_momentum", "squared angular momentum", "N² m² s³", 2, -2}},
};

namespace cost {

template <typename... Rows>
std::variant<typename Rows::Term...> TermOf(const std::tuple<Rows...>&);

// A term of any kind, in the order of the table.
using Term = decltype(TermOf(kCostTable));

}  // namespace cost

template <typename Term>
constexpr const CostRow<Term>& RowOf() {
  return std::get<CostRow<Term>>(kCostTable);
}

inline const CostTraits& TraitsOf(const cost::Term& term) {
  return std::visit([]<typename Kind>(const Kind&) -> const CostTraits& { return RowOf<Kind>().traits; }, term);
}

// Calls visit(row) for each row.
template <typename Visit>
void ForEachCost(Visit visit) {
  std::apply([&visit](const auto&... row) { (visit(row), ...); }, kCostTable);
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COST_TABLE_H_
