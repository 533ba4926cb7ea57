#ifndef ROLLGAIT_CORE_MATH_SCHEME_H_
#define ROLLGAIT_CORE_MATH_SCHEME_H_

#include <string_view>
#include <vector>

#include "core/math/collocation.h"

namespace rollgait {

// The schemes, each a row of the table in scheme.cc.
//   Collocation: Radau IIA has order 2s − 1 with s points and damps what is stiff; Lobatto IIIA (Hermite–Simpson with 3
// points) has order 2s − 2 and damps nothing. Not here: schemes of one point and the trapezoidal rule, in which the
// states at the ends of an interval determine no acceleration (EliminatedScheme); Gauss, whose last point is not the
// end of the interval, where contacts change.
//   Direct multiple shooting, as in the paper: every interval is one step of an explicit method of Runge and Kutta,
// with controls that are constant or linear in it. The stages stay unknowns ("lifted": Albersmeyer and Diehl, SIAM J.
// Optim. 20, 2010), so that the NLPs have the same solutions as those in which an integrator hides them, and
// derivatives are exact.
enum class Scheme {
  kRadau2,
  kRadau3,
  kHermiteSimpson,
  kRadau4,
  kRadau5,
  kLobatto4,
  kLobatto5,
  kShootingConstant,
  kShootingLinear
};

struct SchemeTraits {
  Scheme scheme;
  const char* word;            // as on a command line
  const char* name;            // as in a text
  int order;                   // classical order
  std::vector<double> points;  // c, ascending, 2 to 5, the last 1
  // Of an explicit method: its matrix A below the diagonal, row by row from the second on, and the degree of efforts in
  // an interval. Collocation has none, its A follows from the points; efforts then have degree s − 1.
  std::vector<double> explicit_stages = {};
  int effort_degree = static_cast<int>(points.size()) - 1;
  bool is_collocation() const { return explicit_stages.empty(); }
};

// Of which scheme the polynomials are in which a trajectory is returned: of the scheme itself with collocation, of
// Hermite–Simpson with an explicit method (transcription/returned_points.h).
Scheme ReturnedAs(Scheme scheme);
// Whether efforts change within intervals. Where they do not, they would have no rate but in jumps.
bool HasRatesOfEfforts(Scheme scheme);
// All of them, in the order of the enumeration.
const std::vector<SchemeTraits>& Schemes();
const SchemeTraits& TraitsOf(Scheme scheme);
// Null if none has this word.
const SchemeTraits* FindScheme(std::string_view word);
Tableau TableauOf(Scheme scheme);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_SCHEME_H_
