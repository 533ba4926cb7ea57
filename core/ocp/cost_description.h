#ifndef ROLLGAIT_CORE_OCP_COST_DESCRIPTION_H_
#define ROLLGAIT_CORE_OCP_COST_DESCRIPTION_H_

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/math/cubic_spline.h"
#include "core/ocp/point_function.h"

namespace rollgait {

// ∫ Σ w (dy/dt)² dt, which couples neighbouring instants, of
//   kEfforts  the efforts y = τ_j, one weight per actuated joint; N² m²/s
//   kForces   the forces of the ground y = f, without weights; N²/s. Along x it is the sum over the contacts of a link
//             that counts (of two points of one rigid body only that is determined). A contact that is not active has
//             no force: taking one up and giving it up costs too.
struct RateCost {
  enum class Of { kEfforts, kForces };
  Of of;
  VectorX weights;
  double typical = 1;

  double Typical() const { return typical; }
};

// ∫ Σ w_j (q_j(t) − r_j(t/T))² dt, rad² s (m² s for a prismatic joint), T the duration of all phases together. It knows
// where an instant is in the whole, so it depends on every duration.
struct TrackingCost {
  struct Channel {
    int joint = 0;
    double weight = 1;
    CubicSpline reference;  // rad or m against t/T
  };
  std::vector<Channel> channels;

  double Typical() const;
};

// What is integrated: an integrand that knows a single instant, or one of those that do not.
using CostIntegral = std::variant<std::unique_ptr<PointCost>, RateCost, TrackingCost>;

// One cost term.
struct CostDescription {
  CostIntegral term;
  double weight = 1;
  std::string name = "", unit = "";  // of the integral, for results

  // The integrand if it knows a single instant, else null.
  PointCost* integrand() const {
    const auto* point = std::get_if<std::unique_ptr<PointCost>>(&term);
    return point == nullptr ? nullptr : point->get();
  }
  // Order of magnitude of the integrand in walking, to scale the objective.
  double Typical() const;
  bool IsRateOf(RateCost::Of of) const {
    const auto* rate = std::get_if<RateCost>(&term);
    return rate != nullptr && rate->of == of;
  }
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COST_DESCRIPTION_H_
