#include "core/contact/admissible_forces.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

// A distance below that, m, is none: the two points are one, and have no line between them.
constexpr double kSamePoint = 1e-9;

bool IsAdmissible(const Vector3& force, double friction) {
  // Forces that a solver has put on the cone are off it by rounding.
  return force.head<2>().norm() <= friction * force.z() * (1 + 1e-12) && force.z() >= 0;
}

// The shifts s for which f + s d is in the cone, intersected with [*low, *high]; an empty set leaves *low > *high.
// Contract: d is less steep than the cone, |d_t| > friction · |d_z|, so that the set is an interval.
void CutByCone(const Vector3& f, const Vector3& d, double friction, double* low, double* high) {
  // |t + s d_t|² <= μ² (n + s d_z)²:  A s² + 2 B s + C <= 0 with A > 0.
  const double mu2 = friction * friction;
  const double a = d.head<2>().squaredNorm() - mu2 * d.z() * d.z();
  const double b = f.head<2>().dot(d.head<2>()) - mu2 * f.z() * d.z();
  const double c = f.head<2>().squaredNorm() - mu2 * f.z() * f.z();
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) {
    *low = 1, *high = 0;
    return;
  }
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double s1 = q / a, s2 = q != 0 ? c / q : 0.0;
  if (s1 > s2) std::swap(s1, s2);
  // A line that is less steep than the cone meets one of its two nappes; the other one is the cone of pulling forces.
  if (f.z() + 0.5 * (s1 + s2) * d.z() < 0) {
    *low = 1, *high = 0;
    return;
  }
  *low = std::max(*low, s1);
  *high = std::min(*high, s2);
}

// The line along which two contacts may push against each other; zero if there is none.
Vector3 LineBetween(const LinkContact& first, const LinkContact& second) {
  Vector3 d = first.point - second.point;
  if (!first.along_y && !second.along_y) d.y() = 0;
  const double length = d.norm();
  if (!(length > kSamePoint)) return Vector3::Zero();
  d /= length;
  // A contact that does not transmit a direction of the line cannot push along it.
  const bool blocked_x = !(first.along_x && second.along_x) && std::abs(d.x()) > kSamePoint;
  const bool blocked_y = !(first.along_y && second.along_y) && std::abs(d.y()) > kSamePoint;
  return blocked_x || blocked_y ? Vector3::Zero() : d;
}

bool PairForces(double friction, LinkContact* first, LinkContact* second, const Vector3& d) {
  double low = -kInfinity, high = kInfinity;
  CutByCone(first->force, d, friction, &low, &high);
  if (low <= high) CutByCone(second->force, -d, friction, &low, &high);
  const bool admissible = low <= high;
  double s = 0;
  if (admissible) {
    // Σ |f|² is least where both have the same part along d.
    s = std::clamp(-0.5 * (first->force - second->force).dot(d), low, high);
    first->force += s * d;
    second->force -= s * d;
  } else if (first->force.z() > 0 && second->force.z() > 0) {
    s = LeastRatioShift(first->force.head<2>(), first->force.z(), second->force.head<2>(), second->force.z(),
                        d.head<2>());
    first->force.head<2>() += s * d.head<2>();
    second->force.head<2>() -= s * d.head<2>();
  }
  return admissible;
}

// Projection of one force on the cone |t| <= μ n, and its derivative.
Vector3 ProjectOnCone(const Vector3& z, double friction, Matrix3* derivative) {
  const double r = z.head<2>().norm();
  if (r <= friction * z.z()) {
    derivative->setIdentity();
    return z;
  }
  if (friction * r <= -z.z()) {
    derivative->setZero();
    return Vector3::Zero();
  }
  const Eigen::Vector2d u = z.head<2>() / r;
  const double share = 1 / (1 + friction * friction);
  const double n = (z.z() + friction * r) * share;
  Vector3 edge;  // a generator of the cone; the projection is n · edge
  edge << friction * u, 1;
  *derivative = share * edge * edge.transpose();
  derivative->topLeftCorner<2, 2>() += (friction * n / r) * (Eigen::Matrix2d::Identity() - u * u.transpose());
  return n * edge;
}

// min ½ Σ |f|²  subject to  G f = w  and f in the cones. The solution is f = Π(Gᵀ y) with y the minimum of the convex
// ½ |Π(Gᵀ y)|² − wᵀ y, whose gradient is G Π(Gᵀ y) − w.
class LeastNormDual {
 public:
  LeastNormDual(double friction, std::span<const LinkContact> contacts)
      : friction_(friction), contacts_(static_cast<int>(contacts.size())), wrench_(6, 3 * contacts_) {
    const bool planar = std::none_of(contacts.begin(), contacts.end(), [](const LinkContact& c) { return c.along_y; });
    Vector3 center = Vector3::Zero();
    for (const LinkContact& contact : contacts) center += contact.point / contacts_;
    double lever = 0;
    for (const LinkContact& contact : contacts) {
      lever = std::max(lever, (contact.point - center).norm());
      size_ = std::max(size_, contact.force.cwiseAbs().maxCoeff());
    }
    VectorX force(3 * contacts_);
    for (int c = 0; c < contacts_; ++c) {
      const LinkContact& contact = contacts[c];
      const Vector3 arm = (contact.point - center) / (lever > 0 ? lever : 1.0);
      auto block = wrench_.middleCols<3>(3 * c);
      block.topRows<3>().setIdentity();
      for (int axis = 0; axis < 3; ++axis) block.bottomRows<3>().col(axis) = arm.cross(Vector3::Unit(axis));
      if (!contact.along_x) block.col(0).setZero();
      if (!contact.along_y) block.col(1).setZero();
      force.segment<3>(3 * c) = contact.force / (size_ > 0 ? size_ : 1.0);
    }
    if (planar) {
      for (int row : {1, 3, 5}) wrench_.row(row).setZero();
    }
    target_ = wrench_ * force;
  }

  bool Solve(std::span<LinkContact> contacts) {
    Vector6 y = Vector6::Zero(), gradient;
    double value = Evaluate(y, &gradient);
    for (int i = 0; i < 200 && gradient.norm() > kResidual; ++i) {
      Matrix6 hessian = Matrix6::Zero();
      for (int c = 0; c < contacts_; ++c) {
        const auto block = wrench_.middleCols<3>(3 * c);
        hessian += block * derivatives_[c] * block.transpose();
      }
      // Directions in which the net wrench of these contacts cannot change have no curvature (and no gradient).
      hessian.diagonal().array() += 1e-10 + 1e-3 * std::min(1.0, gradient.squaredNorm());
      const Vector6 step = -hessian.ldlt().solve(gradient);
      const double slope = gradient.dot(step);
      double length = 1;
      Vector6 next = y + step, next_gradient;
      double next_value = Evaluate(next, &next_gradient);
      while (next_value > value + 1e-4 * length * slope + 1e-15 && length > 1e-12) {
        length *= 0.5;
        next = y + length * step;
        next_value = Evaluate(next, &next_gradient);
      }
      y = next, value = next_value, gradient = next_gradient;
    }
    if (!(gradient.norm() <= kAccepted)) return false;
    for (int c = 0; c < contacts_; ++c) contacts[c].force = size_ * force_.segment<3>(3 * c);
    return true;
  }

 private:
  static constexpr double kResidual = 1e-13, kAccepted = 1e-9;  // of the largest force

  double Evaluate(const Vector6& y, Vector6* gradient) {
    force_ = wrench_.transpose() * y;
    derivatives_.resize(contacts_);
    for (int c = 0; c < contacts_; ++c) {
      force_.segment<3>(3 * c) = ProjectOnCone(force_.segment<3>(3 * c), friction_, &derivatives_[c]);
    }
    *gradient = wrench_ * force_ - target_;
    return 0.5 * force_.squaredNorm() - target_.dot(y);
  }

  double friction_;
  int contacts_;
  double size_ = 0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrench_;
  Vector6 target_;
  VectorX force_;
  std::vector<Matrix3> derivatives_;
};

}  // namespace

double LeastRatioShift(const Eigen::Vector2d& t_1, double n_1, const Eigen::Vector2d& t_2, double n_2,
                       const Eigen::Vector2d& d) {
  ROLLGAIT_CHECK(n_1 > 0 && n_2 > 0);
  const double length = d.norm();
  const Eigen::Vector2d u = d / length;
  // Along x = s · length:  ρ_1² = ((x − x_1)² + h_1²) / n_1²,  ρ_2² = ((x − x_2)² + h_2²) / n_2².
  const double x_1 = -t_1.dot(u), x_2 = t_2.dot(u);
  const double h_1 = (t_1 + x_1 * u).squaredNorm(), h_2 = (t_2 - x_2 * u).squaredNorm();
  const double m_1 = n_1 * n_1, m_2 = n_2 * n_2, apart = x_2 - x_1;
  if ((apart * apart + h_2) * m_1 <= h_1 * m_2) return x_1 / length;
  if ((apart * apart + h_1) * m_2 <= h_2 * m_1) return x_2 / length;
  // Between the two bottoms one rises and the other falls. With z = x − x_1:  m_2 (z² + h_1) − m_1 ((z − apart)² + h_2)
  // = 0.
  const double a = m_2 - m_1, b = m_1 * apart, c = m_2 * h_1 - m_1 * (apart * apart + h_2);
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double q = -(b + std::copysign(root, b));
  const auto inside = [apart](double z) { return z * apart >= 0 && std::abs(z) <= std::abs(apart); };
  const double z_1 = c / q, z_2 = q / a;
  const double z = inside(z_1) || !std::isfinite(z_2) ? z_1 : z_2;
  return (x_1 + std::clamp(z, std::min(0.0, apart), std::max(0.0, apart))) / length;
}

bool AdmissibleForces(double friction, std::span<LinkContact> contacts) {
  ROLLGAIT_CHECK(friction >= 0 && std::isfinite(friction));
  const int n = static_cast<int>(contacts.size());
  if (n == 0) return true;
  if (n == 1) return IsAdmissible(contacts[0].force, friction);
  if (n > 2) return LeastNormDual(friction, contacts).Solve(contacts);
  const Vector3 d = LineBetween(contacts[0], contacts[1]);
  // Points above each other do not stand on flat ground; without a line between them there is nothing to choose.
  if (d.head<2>().norm() > friction * std::abs(d.z()) && !d.isZero(0)) {
    return PairForces(friction, &contacts[0], &contacts[1], d);
  }
  return IsAdmissible(contacts[0].force, friction) && IsAdmissible(contacts[1].force, friction);
}

}  // namespace rollgait
