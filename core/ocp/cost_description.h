#ifndef ROLLGAIT_CORE_OCP_COST_DESCRIPTION_H_
#define ROLLGAIT_CORE_OCP_COST_DESCRIPTION_H_

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/math/cubic_spline.h"
#include "core/ocp/point_function.h"

namespace rollgait {

// ∫ Σ w_j (dτ_j/dt)² dt, N² m²/s, one weight per actuated joint. It couples neighbouring instants.
struct EffortRateCost {
  VectorX weights;
  double effort_size = 1;  // N m
};

// ∫ Σ |df/dt|² dt, N²/s, of the forces of the ground. Along x it is the sum over the contacts of a link that counts (of
// two points of one rigid body only that is determined). A contact that is not active has no force: taking one up and
// giving it up costs too.
struct ForceRateCost {
  double force_size = 1;  // N
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
};

// One cost term: an integrand that knows a single instant, or one of those that do not.
struct CostDescription {
  std::variant<std::unique_ptr<PointCost>, EffortRateCost, ForceRateCost, TrackingCost> term;
  double weight = 1;

  // The integrand if it knows a single instant, else null.
  PointCost* integrand() const {
    const auto* point = std::get_if<std::unique_ptr<PointCost>>(&term);
    return point == nullptr ? nullptr : point->get();
  }
  std::string Name() const;
  std::string Unit() const;  // of the integral
  // Order of magnitude of the integrand in walking, to scale the objective.
  double Typical() const;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COST_DESCRIPTION_H_
