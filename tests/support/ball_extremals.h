#ifndef ROLLGAIT_TESTS_SUPPORT_BALL_EXTREMALS_H_
#define ROLLGAIT_TESTS_SUPPORT_BALL_EXTREMALS_H_

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <optional>

#include "core/math/integrator.h"
#include "tests/support/seeded_random.h"

namespace rollgait {

// The least ∫|M|² dt that carries a homogeneous ball from rest to rest on level ground, by Pontryagin's principle.
// World axes; position (x, y), orientation R, angular velocity ω, J = diag(I + m r², I + m r², I), and a costate of
// each:
//   x' = r ω_y,  y' = −r ω_x,  R' = [ω] R,  J ω' = M = −J⁻¹ p / 2,
//   λ' = 0 (two numbers),  Λ' = ω × Λ (the costate of R, fixed in the body),  p' = −Λ − r (−λ_y, λ_x, 0).
// Eight unknowns at t = 0 (λ, Λ, p) against eight conditions at the end. Shooting with Levenberg–Marquardt from many
// random starts; it has no mesh and shares no code with the transcription.
class BallExtremals {
 public:
  BallExtremals(double mass, double radius, double duration)
      : radius_(radius),
        duration_(duration),
        spin_(0.4 * mass * radius * radius),
        roll_(1.4 * mass * radius * radius) {}

  using Unknowns = Eigen::Matrix<double, 8, 1>;

  // The cost of the cheapest extremal that the starts lead to. N² m² s.
  std::optional<double> Least(const Eigen::Vector2d& place, const Eigen::Quaterniond& orientation, int starts,
                              unsigned seed) const {
    SeededRandom random(seed);
    std::optional<double> least;
    for (int k = 0; k < starts; ++k) {
      const Unknowns start = random.VectorOf(8, -0.3, 0.3);
      const std::optional<double> cost = Follow(start, place, orientation);
      if (cost && (!least || *cost < *least)) least = cost;
    }
    return least;
  }

 private:
  struct Shot {
    Unknowns miss;
    double cost;
  };

  // Unknowns are in units of what turns the ball by about 10 rad.
  Shot Shoot(const Unknowns& u, const Eigen::Vector2d& place, const Eigen::Quaterniond& orientation) const {
    const double torque = 60 * roll_ / (duration_ * duration_), couple = 2 * roll_ * torque;
    const Eigen::Vector2d lambda = u.head<2>() * couple / (duration_ * radius_);
    VectorX x = VectorX::Zero(16);
    x(2) = 1;
    x.segment<3>(9) = u.segment<3>(2) * couple / duration_ * 4;
    x.segment<3>(12) = u.tail<3>() * couple;
    const auto slope = [&](double, const VectorX& at, VectorX* d) {
      const Vector3 w = at.segment<3>(6), p = at.segment<3>(12);
      const Vector3 moment = -0.5 * Vector3(p.x() / roll_, p.y() / roll_, p.z() / spin_);
      (*d)(0) = radius_ * w.y();
      (*d)(1) = -radius_ * w.x();
      const Vector3 v = at.segment<3>(3);
      (*d)(2) = -0.5 * w.dot(v);
      d->segment<3>(3) = 0.5 * (at(2) * w + w.cross(v));
      d->segment<3>(6) = Vector3(moment.x() / roll_, moment.y() / roll_, moment.z() / spin_);
      d->segment<3>(9) = w.cross(Vector3(at.segment<3>(9)));
      d->segment<3>(12) = -at.segment<3>(9) - radius_ * Vector3(-lambda.y(), lambda.x(), 0);
      (*d)(15) = moment.squaredNorm();
    };
    Dop853 integrator;
    Dop853::Options options;
    options.tolerance = 1e-9;
    Shot shot{Unknowns::Constant(1e6), 0};
    if (integrator.Integrate(slope, 0, duration_, options, &x) != IntegrationStatus::kReachedEnd) return shot;
    const Eigen::Quaterniond off = Eigen::Quaterniond(x(2), x(3), x(4), x(5)).normalized() * orientation.conjugate();
    shot.miss << (x.head<2>() - place) / radius_, 2 * (off.w() < 0 ? -1 : 1) * off.vec(), x.segment<3>(6) * duration_;
    shot.cost = x(15);
    return shot;
  }

  std::optional<double> Follow(Unknowns u, const Eigen::Vector2d& place, const Eigen::Quaterniond& orientation) const {
    Shot shot = Shoot(u, place, orientation);
    double damping = 1e-2;
    for (int k = 0; k < 60 && damping < 1e8; ++k) {
      if (shot.miss.norm() < 1e-9) return shot.cost;
      Eigen::Matrix<double, 8, 8> jacobian;
      constexpr double kStep = 1e-5;
      for (int j = 0; j < 8; ++j) {
        Unknowns ahead = u;
        ahead(j) += kStep;
        jacobian.col(j) = (Shoot(ahead, place, orientation).miss - shot.miss) / kStep;
      }
      const Eigen::Matrix<double, 8, 8> normal = jacobian.transpose() * jacobian;
      const Unknowns gradient = jacobian.transpose() * shot.miss;
      for (; damping < 1e8; damping *= 4) {
        const Unknowns step =
            (normal + damping * Eigen::Matrix<double, 8, 8>::Identity()).colPivHouseholderQr().solve(gradient);
        const Shot next = Shoot(u - step, place, orientation);
        if (next.miss.norm() >= shot.miss.norm()) continue;
        u -= step;
        shot = next;
        damping = std::max(1e-12, damping / 10);
        break;
      }
    }
    return std::nullopt;
  }

  double radius_, duration_, spin_, roll_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_BALL_EXTREMALS_H_
