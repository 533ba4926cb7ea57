#include "bench/verdict_audit/overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rollgait::audit {
namespace {

double Support(const WorldBody& body, const Vector3& nu) { return body.shape.Support(body.R_WE.transpose() * nu); }

// Distance between the two tangent planes with normal ν; positive for some ν: the bodies do not meet.
double Gap(const WorldBody& first, const WorldBody& second, const Vector3& nu) {
  return nu.dot(second.center - first.center) - Support(first, nu) - Support(second, nu);
}

// Compass search on the sphere for the largest gap: tries turns in four directions and halves them where none is
// better.
double Climb(const WorldBody& first, const WorldBody& second, Vector3* nu) {
  double best = Gap(first, second, *nu);
  for (double turn = 0.2; turn > 1e-9 && best <= 0;) {
    const Vector3 u = nu->unitOrthogonal(), w = nu->cross(u);
    bool better = false;
    for (const Vector3& tangent : {u, Vector3(-u), w, Vector3(-w)}) {
      const Vector3 tried = (*nu + turn * tangent).normalized();
      const double gap = Gap(first, second, tried);
      if (gap <= best) continue;
      best = gap;
      *nu = tried;
      better = true;
      break;
    }
    if (!better) turn /= 2;
  }
  return best;
}

// Points spread evenly over the sphere (Fibonacci lattice).
std::vector<Vector3> Spread(int count) {
  std::vector<Vector3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

}  // namespace

double Overlap(const WorldBody& first, const WorldBody& second, Vector3* direction) {
  if (Gap(first, second, *direction) > 0) return 0;
  static const std::vector<Vector3> spread = Spread(400);
  Vector3 best_direction = *direction;
  double best = Climb(first, second, &best_direction);
  if (best <= 0) {
    // From the best eight of the spread: while the bodies overlap, there may be several local maxima.
    std::vector<std::pair<double, Vector3>> starts;
    for (const Vector3& nu : spread) starts.emplace_back(Gap(first, second, nu), nu);
    std::partial_sort(starts.begin(), starts.begin() + 8, starts.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    for (int i = 0; i < 8 && best <= 0; ++i) {
      Vector3 nu = starts[static_cast<size_t>(i)].second;
      const double gap = Climb(first, second, &nu);
      if (gap <= best) continue;
      best = gap;
      best_direction = nu;
    }
  }
  *direction = best_direction;
  return std::max(0.0, -best);
}

}  // namespace rollgait::audit
