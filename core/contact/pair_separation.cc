#include "core/contact/pair_separation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/contact/pair_tangent.h"
#include "core/contact/separating_plane.h"

namespace rollgait {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Budget of steps; of those that shorten both components of a step alike; and of those that gain nothing.
constexpr int kMaxSteps = 400, kJointSteps = 40, kIdleSteps = 8;
constexpr double kLargestStep = 0.5, kSmallestStep = 1e-17, kBeside = 1e-13;  // rad

class NewtonOnTheSphere {
 public:
  NewtonOnTheSphere(const PosedSurface& body_1, const PosedSurface& body_2)
      : body_1_(body_1), body_2_(body_2), offset_(body_2.p_WE - body_1.p_WE) {}

  // Ends at a local maximum of g: where the slope is what rounding of the points (ε L) and of ν (ε S) leaves of it, or
  // where step after step gains no more than the rounding of g (surfaces almost flat, whose points jump about).
  Separation Ascend(const Vector3& start) const {
    Separation at;
    Evaluate(start.normalized(), &at);
    double last_step = kInfinity;
    int idle = 0;
    for (at.iterations = 0; at.iterations < kMaxSteps && !at.converged; ++at.iterations) {
      const Newton newton = Step(at);
      const double length = newton.step.norm(), before = at.distance;
      const bool stalled = last_step < 1e-7 && length > 0.25 * last_step && length < 3 * last_step;
      if (newton.residual <= 0.5 || (stalled && newton.residual <= 32)) {
        at.converged = !Probe(newton, &at);
      } else {
        at.converged = !Advance(newton, at.iterations >= kJointSteps || idle >= kIdleSteps, &at);
      }
      idle = at.distance - before > 8 * Noise(at) ? 0 : idle + 1;
      at.converged = at.converged || idle > 4 * kIdleSteps;
      last_step = length;
    }
    return at;
  }

  void Evaluate(const Vector3& nu, Separation* at) const {
    const Vector3 nu_1 = body_1_.R_WE.transpose() * nu, nu_2 = -(body_2_.R_WE.transpose() * nu);
    at->nu = nu;
    at->r_1 = body_1_.R_WE * body_1_.surface->SupportPoint(nu_1);
    at->r_2 = body_2_.R_WE * body_2_.surface->SupportPoint(nu_2);
    at->distance = nu.dot(offset_) - body_1_.surface->Support(nu_1) - body_2_.surface->Support(nu_2);
  }

 private:
  struct Newton {
    Eigen::Matrix<double, 3, 2> basis;  // tangent, S₁ + S₂ + d I is diagonal in it
    Eigen::Vector2d slope;              // of g along it, m
    Eigen::Vector2d step;               // rad
    double residual;                    // largest component of the slope in units of its rounding
  };

  // Newton's step where g is concave on the sphere, with |curvature| elsewhere. Where a surface is exactly flat its
  // curvature is that of a normal next to it: huge, in the right directions.
  Newton Step(const Separation& at) const {
    PairTangent tangent(body_1_, body_2_, at.nu, at.distance);
    if (!tangent.finite) {
      const Vector3 beside = (at.nu + kBeside * Vector3(0.48, 0.6, 0.64)).normalized();
      tangent = PairTangent(body_1_, body_2_, beside, at.distance);
    }
    Newton newton;
    newton.basis = tangent.basis;
    newton.slope = Slope(at, tangent.basis);
    const double noise = Noise(at), size = newton.slope.norm();
    if (!tangent.finite) {
      newton.step = newton.slope * (size > 0 ? kLargestStep / size : 0);
      newton.residual = size / noise;
    } else {
      const Eigen::Array2d curvature =
          tangent.curvature.array().abs().max(kEpsilon * tangent.curvature.cwiseAbs().maxCoeff());
      newton.step = newton.slope.array() / curvature;
      newton.step *= std::min(1.0, kLargestStep / newton.step.norm());
      newton.residual = (newton.slope.array().abs() / (noise + kEpsilon * curvature)).maxCoeff();
    }
    return newton;
  }

  Eigen::Vector2d Slope(const Separation& at, const Eigen::Matrix<double, 3, 2>& basis) const {
    return basis.transpose() * (offset_ + at.r_2 - at.r_1);
  }

  // Rounding of g and of the points, m.
  double Noise(const Separation& at) const { return kEpsilon * (offset_.norm() + at.r_1.norm() + at.r_2.norm()); }

  // Near a flat face S can be so large that rounding of ν seems to explain any slope, and at a bend within a few
  // roundings of ν there is no one slope. Moves by as much along the shortest vector in the hull of the slopes that it
  // has found, and returns true if the slope does not turn round there; false if the hull reaches the origin, as it
  // does at a maximum of a concave function.
  bool Probe(const Newton& newton, Separation* at) const {
    const double noise = 2 * Noise(*at);
    std::array<Eigen::Vector2d, 8> slopes;
    slopes[0] = (newton.slope.array().abs() > noise).select(newton.slope, 0.0);
    for (size_t count = 1; count < slopes.size(); ++count) {
      const Eigen::Vector2d up = ShortestInHull(slopes, count);
      if (up.norm() <= noise) return false;
      Separation next = *at;
      Evaluate((at->nu + newton.basis * (8 * kEpsilon * up.normalized())).normalized(), &next);
      slopes[count] = Slope(next, newton.basis);
      if (slopes[count].dot(up) > 0) {
        *at = next;
        return true;
      }
    }
    return false;
  }

  // Of the convex hull of the first `count` vectors; zero if it holds the origin. O(count²).
  static Eigen::Vector2d ShortestInHull(const std::array<Eigen::Vector2d, 8>& vectors, size_t count) {
    Eigen::Vector2d shortest = vectors[0];
    for (size_t i = 0; i < count; ++i) {
      for (size_t j = 0; j < i; ++j) {
        const Eigen::Vector2d edge = vectors[i] - vectors[j];
        const double part = edge.isZero(0) ? 0 : std::clamp(-vectors[j].dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        const Eigen::Vector2d nearest = vectors[j] + part * edge;
        if (nearest.squaredNorm() < shortest.squaredNorm()) shortest = nearest;
      }
    }
    // All vectors lie beyond it as seen from the origin, unless they surround that.
    for (size_t i = 0; i < count; ++i) {
      if (vectors[i].dot(shortest) <= 0) return Eigen::Vector2d::Zero();
    }
    return shortest;
  }

  // Shortens the step until g grows by a part of what the slope promises (below rounding any step will do). With
  // `by_component`, one component of it alone where it runs past a bend so sharp that the slope turns round: almost
  // flat faces bend over less than a step, and would hold up the other component.
  bool Advance(const Newton& newton, bool by_component, Separation* at) const {
    const double noise = 8 * Noise(*at);
    Eigen::Vector2d step = newton.step;
    Separation next = *at;
    while (step.norm() > kSmallestStep) {
      Evaluate((at->nu + newton.basis * step).normalized(), &next);
      const Eigen::Array2d slope = Slope(next, newton.basis).array() * newton.slope.array().sign();
      const Eigen::Array2d before = newton.slope.array().abs();
      const double promise = step.dot(newton.slope);
      const bool grows = next.distance >= at->distance + 1e-4 * promise;
      const bool by_rounding = promise < noise && next.distance >= at->distance - noise;
      bool shortened = false;
      for (int i = 0; by_component && i < 2; ++i) {
        if (slope[i] >= -0.5 * before[i] || before[i] <= noise || std::abs(step[i]) < kSmallestStep) continue;
        step[i] /= 2;
        shortened = true;
      }
      if (!shortened && (grows || by_rounding)) {
        *at = step == newton.step ? Lengthened(newton, at->nu, step, next) : next;
        return true;
      }
      if (!shortened) step /= 2;
    }
    return false;
  }

  // Where Newton's step from nu ends, at `next`, the slope should have vanished. A component that keeps more than half
  // of it there doubles for as long as it does and g grows by more than its rounding: at the tip of a pointed surface
  // the curvature is large, over less than a step, and Newton's steps would creep.
  Separation Lengthened(const Newton& newton, const Vector3& nu, Eigen::Vector2d step, Separation next) const {
    const Eigen::Array2d sign = newton.slope.array().sign(), before = newton.slope.array().abs();
    while (true) {
      const Eigen::Array2d slope = Slope(next, newton.basis).array() * sign;
      const Eigen::Vector2d longer = (slope > 0.5 * before).select(2 * step, step);
      if (longer == step || longer.norm() > kLargestStep) return next;
      Separation further = next;
      Evaluate((nu + newton.basis * longer).normalized(), &further);
      if (!(further.distance > next.distance + 8 * Noise(next))) return next;
      step = longer;
      next = further;
    }
  }

  const PosedSurface& body_1_;
  const PosedSurface& body_2_;
  Vector3 offset_;
};

}  // namespace

Separation FindSeparation(const PosedSurface& body_1, const PosedSurface& body_2, const Vector3* start) {
  const NewtonOnTheSphere newton(body_1, body_2);
  const Vector3 offset = body_2.p_WE - body_1.p_WE;
  const double size = offset.norm();
  Separation best = newton.Ascend(start != nullptr ? *start : size > 0 ? Vector3(offset / size) : Vector3::UnitZ());
  if (best.distance > 0) {
    best.state = Separation::State::kSeparated;
    return best;
  }
  const SeparatingPlane plane = FindSeparatingPlane(body_1, body_2);
  int iterations = best.iterations;
  if (plane.state == SeparatingPlane::State::kFound) {
    best = newton.Ascend(plane.nu);
    best.state = Separation::State::kSeparated;
  } else {
    for (int i = 0; start == nullptr && i < 12; ++i) {
      const Matrix3& axes = i < 6 ? body_1.R_WE : body_2.R_WE;
      const Separation other = newton.Ascend((i % 2 == 0 ? 1 : -1) * axes.col(i % 6 / 2));
      iterations += other.iterations;
      if (other.distance > best.distance) best = other;
    }
    best.state = best.distance > 0                              ? Separation::State::kSeparated
                 : plane.state == SeparatingPlane::State::kNone ? Separation::State::kOverlap
                                                                : Separation::State::kTouching;
    best.iterations = 0;
  }
  best.iterations += iterations;
  best.support_evaluations = plane.support_evaluations;
  return best;
}

}  // namespace rollgait
