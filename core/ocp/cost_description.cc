#include "core/ocp/cost_description.h"

namespace rollgait {
namespace {

using PointTerm = std::unique_ptr<PointCost>;

struct NameOf {
  std::string operator()(const PointTerm& term) const { return term->Name(); }
  std::string operator()(const EffortRateCost&) const { return "squared torque rate"; }
  std::string operator()(const ForceRateCost&) const { return "squared force rate"; }
  std::string operator()(const TrackingCost&) const { return "tracking"; }
};

struct UnitOf {
  std::string operator()(const PointTerm& term) const { return term->Unit(); }
  std::string operator()(const EffortRateCost&) const { return "N² m²/s"; }
  std::string operator()(const ForceRateCost&) const { return "N²/s"; }
  std::string operator()(const TrackingCost&) const { return "rad² s"; }
};

struct TypicalOf {
  double operator()(const PointTerm& term) const { return term->Typical(); }
  // Efforts change by a third of their size in a tenth of a second.
  double operator()(const EffortRateCost& term) const {
    const double rate = term.effort_size / 0.3;
    return term.weights.sum() * rate * rate;
  }
  // A foot takes up the weight in a fifth of a second.
  double operator()(const ForceRateCost& term) const {
    const double rate = term.force_size / 0.2;
    return rate * rate;
  }
  // A reference is met to about 0.1 rad.
  double operator()(const TrackingCost& term) const {
    double sum = 0;
    for (const TrackingCost::Channel& channel : term.channels) sum += channel.weight;
    return 0.01 * sum;
  }
};

}  // namespace

std::string CostDescription::Name() const { return std::visit(NameOf(), term); }
std::string CostDescription::Unit() const { return std::visit(UnitOf(), term); }
double CostDescription::Typical() const { return std::visit(TypicalOf(), term); }

}  // namespace rollgait
