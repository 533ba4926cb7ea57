#include "core/gait/power_smoothing.h"

#include <algorithm>
#include <variant>

namespace rollgait {
std::optional<double>* SmoothingOf(GaitSpec::CostTerm* cost) {
  std::optional<double>* smoothing = nullptr;
  std::visit(
      [&smoothing]<typename Term>(Term& term) {
        RowOf<Term>().ForEachParameter([&](const CostParameter<Term>& parameter) {
          if (parameter.is_smoothing) smoothing = &(term.*parameter.member);
        });
      },
      cost->term);
  return smoothing;
}

std::optional<double> LeastSmoothing(const GaitSpec& spec) {
  std::optional<double> least;
  for (GaitSpec::CostTerm cost : spec.costs) {
    const std::optional<double>* smoothing = SmoothingOf(&cost);
    if (smoothing && (!least || **smoothing < *least)) least = *smoothing;
  }
  return least;
}

GaitSpec SmoothedBy(double smoothing, GaitSpec spec) {
  for (GaitSpec::CostTerm& cost : spec.costs) {
    if (std::optional<double>* of_term = SmoothingOf(&cost)) **of_term = std::max(**of_term, smoothing);
  }
  return spec;
}

}  // namespace rollgait
