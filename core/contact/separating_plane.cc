#include "core/contact/separating_plane.h"

#include <Eigen/Cholesky>
#include <limits>

namespace rollgait {
namespace {

constexpr double kMachineEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxSupports = 400;

// Up to four points, and the point of their hull next to the origin.
struct Simplex {
  Vector3 points[4];
  int size = 0;
  Vector3 nearest;

  // Tries every subset: the right one has the nearest point of its affine hull inside, and keeps only its points.
  void Reduce() {
    double best = kInfinity;
    int best_subset = 0;
    for (int subset = 1; subset < 1 << size; ++subset) {
      const Vector3* chosen[4] = {points};
      int count = 0;
      for (int i = 0; i < size; ++i) {
        if (subset >> i & 1) chosen[count++] = &points[i];
      }
      Vector3 point = *chosen[0];
      if (count > 1) {
        Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, count - 1);
        for (int i = 1; i < count; ++i) edges.col(i - 1) = *chosen[i] - *chosen[0];
        const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = edges.transpose() * edges;
        const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> right = -edges.transpose() * *chosen[0];
        const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights = gram.ldlt().solve(right);
        if (!(weights.minCoeff() >= 0 && weights.sum() <= 1)) continue;
        point += edges * weights;
      }
      if (point.squaredNorm() < best) {
        best = point.squaredNorm();
        best_subset = subset;
        nearest = point;
      }
    }
    int kept = 0;
    for (int i = 0; i < size; ++i) {
      if (best_subset >> i & 1) points[kept++] = points[i];
    }
    size = kept;
  }
};

}  // namespace

SeparatingPlane FindSeparatingPlane(const PosedSurface& body_1, const PosedSurface& body_2) {
  SeparatingPlane plane;
  const auto support = [&](const Vector3& nu) -> Vector3 {
    ++plane.support_evaluations;
    return (body_2.p_WE - body_1.p_WE) + body_2.R_WE * body_2.surface->SupportPoint(-(body_2.R_WE.transpose() * nu)) -
           body_1.R_WE * body_1.surface->SupportPoint(body_1.R_WE.transpose() * nu);
  };
  Simplex simplex;
  simplex.points[0] = support(Vector3::UnitZ());
  simplex.size = 1;
  double largest = simplex.points[0].norm();
  while (plane.support_evaluations < kMaxSupports) {
    simplex.Reduce();
    const double distance = simplex.nearest.norm();
    if (simplex.size == 4 || distance <= 4 * kMachineEpsilon * largest) {
      plane.state = SeparatingPlane::State::kNone;
      return plane;
    }
    plane.nu = simplex.nearest / distance;
    const Vector3 next = support(plane.nu);
    largest = std::max(largest, next.norm());
    const double g = plane.nu.dot(next);
    if (g > 4 * kMachineEpsilon * largest) {
      plane.state = SeparatingPlane::State::kFound;
      return plane;
    }
    // `nearest` cannot come closer to the origin than g, which is not positive; no new point means rounding.
    for (int i = 0; i < simplex.size; ++i) {
      if (simplex.points[i] == next) return plane;
    }
    simplex.points[simplex.size++] = next;
  }
  return plane;
}

}  // namespace rollgait
