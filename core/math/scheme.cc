#include "core/math/scheme.h"

#include <cmath>

namespace rollgait {

// Points of Radau IIA: the zeros of P_{s−1} − P_s, of Lobatto IIIA: −1, 1 and the zeros of P'_{s−1}, moved from [−1, 1]
// to [0, 1]; P are Legendre's polynomials. Those without a root that can be written down have 20 digits. Shooting takes
// Kutta's 3/8 rule, order 4 (Hairer, Nørsett and Wanner I, table II.1.2): unlike the other classical rule of that order
// it has no two stages at one instant, so that polynomials run through them.
const std::vector<SchemeTraits>& Schemes() {
  static const double six = std::sqrt(6.0), five = std::sqrt(5.0), twenty_one = std::sqrt(21.0);
  static const std::vector<double> kutta = {0, 1.0 / 3, 2.0 / 3, 1}, kutta_stages = {1.0 / 3, -1.0 / 3, 1, 1, -1, 1};
  static const std::vector<SchemeTraits> table = {
      {Scheme::kRadau2, "radau2", "Radau-2", 3, {1.0 / 3, 1}},
      {Scheme::kRadau3, "radau3", "Radau-3", 5, {(4 - six) / 10, (4 + six) / 10, 1}},
      {Scheme::kHermiteSimpson, "hermite-simpson", "Hermite–Simpson", 4, {0, 0.5, 1}},
      {Scheme::kRadau4,
       "radau4",
       "Radau-4",
       7,
       {0.088587959512703947396, 0.40946686444073471086, 0.78765946176084705603, 1}},
      {Scheme::kRadau5,
       "radau5",
       "Radau-5",
       9,
       {0.057104196114517682193, 0.27684301363812382768, 0.58359043236891682006, 0.86024013565621944785, 1}},
      {Scheme::kLobatto4, "lobatto4", "Lobatto-4", 6, {0, (5 - five) / 10, (5 + five) / 10, 1}},
      {Scheme::kLobatto5, "lobatto5", "Lobatto-5", 8, {0, (7 - twenty_one) / 14, 0.5, (7 + twenty_one) / 14, 1}},
      {Scheme::kShootingConstant, "shooting-constant", "shooting, constant", 4, kutta, kutta_stages, 0},
      {Scheme::kShootingLinear, "shooting-linear", "shooting, linear", 4, kutta, kutta_stages, 1},
  };
  return table;
}

const SchemeTraits& TraitsOf(Scheme scheme) { return Schemes().at(static_cast<size_t>(scheme)); }

const SchemeTraits* FindScheme(std::string_view word) {
  for (const SchemeTraits& traits : Schemes()) {
    if (traits.word == word) return &traits;
  }
  return nullptr;
}

Scheme ReturnedAs(Scheme scheme) { return TraitsOf(scheme).is_collocation() ? scheme : Scheme::kHermiteSimpson; }

bool HasRatesOfEfforts(Scheme scheme) { return TraitsOf(scheme).effort_degree > 0; }

Tableau TableauOf(Scheme scheme) {
  const SchemeTraits& traits = TraitsOf(scheme);
  const Eigen::Map<const VectorX> points(traits.points.data(), static_cast<Eigen::Index>(traits.points.size()));
  if (traits.is_collocation()) return CollocationTableau(points, traits.order);
  return ExplicitTableau(points, traits.explicit_stages, traits.order, traits.effort_degree);
}

}  // namespace rollgait
