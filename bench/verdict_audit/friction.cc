#include "bench/verdict_audit/friction.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace rollgait::audit {
namespace {

double Ratio(const Vector3& force, double floor) {
  return std::hypot(force.x(), force.y()) / std::max(force.z(), floor);
}

// The ratio is a largest of convex functions of the internal force, so a golden-section search finds its least value.
double LeastRatioOfTwo(const Vector3& line, const Vector3& first, const Vector3& second, double floor) {
  const auto ratio = [&](double internal) {
    return std::max(Ratio(first + internal * line, floor), Ratio(second - internal * line, floor));
  };
  const double golden = (std::sqrt(5.0) - 1) / 2;
  const double reach = first.norm() + second.norm();  // beyond it, one contact has more to hold than both have now
  double low = -reach, high = reach;
  for (int i = 0; i < 100; ++i) {  // 0.618^100 = 1e-21
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (ratio(a) < ratio(b) ? high : low) = ratio(a) < ratio(b) ? b : a;
  }
  return std::min(ratio(0), ratio((low + high) / 2));
}

}  // namespace

double LeastFrictionRatio(const Scene& scene, const std::vector<int>& contacts, const std::vector<Vector3>& points,
                          const std::vector<Vector3>& forces, double floor) {
  double largest = 0;
  for (size_t i = 0; i < contacts.size(); ++i) {
    const ContactSurface& contact = scene.contacts[static_cast<size_t>(contacts[i])];
    std::vector<size_t> others;
    for (size_t k = 0; k < contacts.size(); ++k) {
      if (k != i && scene.contacts[static_cast<size_t>(contacts[k])].joint == contact.joint) others.push_back(k);
    }
    ROLLGAIT_CHECK(others.size() <= 1);
    if (others.empty()) {
      largest = std::max(largest, Ratio(forces[i], floor));
      continue;
    }
    if (others[0] < i) continue;  // that pair was looked at
    Vector3 line = points[others[0]] - points[i];
    for (int d = 0; d < 3; ++d) {
      if (std::find(contact.directions.begin(), contact.directions.end(), d) == contact.directions.end()) line[d] = 0;
    }
    largest = std::max(largest, LeastRatioOfTwo(line.normalized(), forces[i], forces[others[0]], floor));
  }
  return largest;
}

}  // namespace rollgait::audit
