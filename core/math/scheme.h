#ifndef ROLLGAIT_CORE_MATH_SCHEME_H_
#define ROLLGAIT_CORE_MATH_SCHEME_H_

#include <string_view>
#include <vector>

#include "core/math/collocation.h"

namespace rollgait {

// The collocation schemes, each a row of the table in scheme.cc. Radau IIA has order 2s − 1 with s points and damps
// what is stiff; Lobatto IIIA (Hermite–Simpson with 3 points) has order 2s − 2 and damps nothing. Not here: schemes of
// one point and the trapezoidal rule, in which the states at the ends of an interval determine no acceleration
// (EliminatedScheme); Gauss, whose last point is not the end of the interval, where contacts change.
enum class Scheme { kRadau2, kRadau3, kHermiteSimpson, kRadau4, kRadau5, kLobatto4, kLobatto5 };

struct SchemeTraits {
  Scheme scheme;
  const char* word;            // as on a command line
  const char* name;            // as in a text
  int order;                   // classical order
  std::vector<double> points;  // c, ascending, 2 to 5, the last 1
};

// All of them, in the order of the enumeration.
const std::vector<SchemeTraits>& Schemes();
const SchemeTraits& TraitsOf(Scheme scheme);
// Null if none has this word.
const SchemeTraits* FindScheme(std::string_view word);
Tableau TableauOf(Scheme scheme);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_SCHEME_H_
