#ifndef ROLLGAIT_TESTS_CONFORMANCE_SURFACE_CASES_H_
#define ROLLGAIT_TESTS_CONFORMANCE_SURFACE_CASES_H_

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "core/geometry/surface.h"

namespace rollgait {

// One kind of surface as the conformance suite sees it.
struct SurfaceCase {
  std::string name;
  // The body, `scale` times as large.
  std::function<Surface(double scale)> make;
  // Negative inside, zero on the surface of make(1), positive outside, written anew from the definition; empty if the
  // body has no such equation.
  std::function<double(const Vector3& x)> equation;
  // Normals are drawn with every component at least this large: 0 where h is smooth everywhere, more where flats or
  // edges lie on the coordinate planes of ν.
  double least_component = 0;
  // How fast derivatives grow with their order, for step sizes: h changes over this angle.
  double angle = 1;
};

inline std::ostream& operator<<(std::ostream& out, const SurfaceCase& surface_case) { return out << surface_case.name; }

const std::vector<SurfaceCase>& SurfaceCases();

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CONFORMANCE_SURFACE_CASES_H_
