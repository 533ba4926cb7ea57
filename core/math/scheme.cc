#include "core/math/scheme.h"

#include <cmath>

namespace rollgait {

// Points of Radau IIA: the zeros of P_{s−1} − P_s, of Lobatto IIIA: −1, 1 and the zeros of P'_{s−1}, moved from [−1, 1]
// to [0, 1]; P are Legendre's polynomials. Those without a root that can be written down have 20 digits.
const std::vector<SchemeTraits>& Schemes() {
  static const double six = std::sqrt(6.0), five = std::sqrt(5.0), twenty_one = std::sqrt(21.0);
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

Tableau TableauOf(Scheme scheme) {
  const SchemeTraits& traits = TraitsOf(scheme);
  const int s = static_cast<int>(traits.points.size());
  return CollocationTableau(Eigen::Map<const VectorX>(traits.points.data(), s), traits.order);
}

}  // namespace rollgait
