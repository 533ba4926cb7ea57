#include "core/contact/impact.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

// An impulse or separation this far below zero, relative to the size of the impact, is rounding.
constexpr double kRounding = 1e-10;

class ImpactSolver {
 public:
  explicit ImpactSolver(ContactDynamics* dynamics)
      : dynamics_(*dynamics), solver_(dynamics->dynamics().model().ColumnParents()) {}

  Impact Solve(const std::vector<int>& held, const std::vector<int>& touching) {
    Impact impact;
    impact.held = held;
    for (int k : touching) {
      if (!std::binary_search(held.begin(), held.end(), k)) impact.released.push_back(k);
    }
    dynamics_.VelocityRows(held, &jacobian_, &rate_);
    const MatrixX& mass = dynamics_.MassMatrix();
    const VectorX& before = dynamics_.velocity();
    if (dynamics_.AnySlides(held)) {
      dynamics_.ForceRows(held, jacobian_, &force_jacobian_);
      solver_.SolveSliding(mass, VectorX::Zero(before.size()), jacobian_, force_jacobian_, -rate_, &solution_);
    } else {
      solver_.Solve(mass, VectorX::Zero(before.size()), jacobian_, -rate_, &solution_);
    }
    const VectorX& change = solution_.acceleration;
    impact.velocity = before + change;
    impact.redundant = !solution_.ForcesUnique();
    impact.energy_loss = -change.dot(mass * before) - 0.5 * change.dot(mass * change);
    dynamics_.Distribute(held, solution_.forces, &impact.impulses, &impact.spin_impulses);
    impact.gap_rates.assign(dynamics_.contact_count(), 0.0);
    double impulse_size = 0, rate_size = 0;
    for (int k : touching) {
      dynamics_.SlipJacobian(k, &linear_, &angular_);
      const Vector3& n = dynamics_.Kinematics(k).normal;
      const double change_of_rate = n.dot(linear_ * change);
      impact.gap_rates[k] = dynamics_.Kinematics(k).gap_rate + change_of_rate;
      rate_size = std::max({rate_size, std::abs(dynamics_.Kinematics(k).gap_rate), std::abs(change_of_rate)});
      impulse_size = std::max(impulse_size, impact.impulses[k].norm());
    }
    for (int k : held) {
      if (impact.impulses[k].dot(dynamics_.Kinematics(k).normal) < -kRounding * impulse_size) impact.consistent = false;
    }
    for (int k : impact.released) {
      if (impact.gap_rates[k] < -kRounding * rate_size) impact.consistent = false;
    }
    return impact;
  }

 private:
  ContactDynamics& dynamics_;
  ConstrainedSolver solver_;
  ConstrainedSolution solution_;
  MatrixX jacobian_, force_jacobian_, linear_, angular_;
  VectorX rate_;
};

}  // namespace

Impact ResolveImpact(const std::vector<int>& touching, const std::vector<int>& must_hold, ContactDynamics* dynamics) {
  std::vector<int> optional;
  for (int k : touching) {
    if (!std::binary_search(must_hold.begin(), must_hold.end(), k)) optional.push_back(k);
  }
  ROLLGAIT_CHECK(optional.size() <= 16);
  ImpactSolver solver(dynamics);
  const unsigned sets = 1u << optional.size();
  for (int count = 0; count <= static_cast<int>(optional.size()); ++count) {
    for (unsigned set = 0; set < sets; ++set) {
      if (std::popcount(set) != count) continue;
      std::vector<int> held = must_hold;
      for (size_t i = 0; i < optional.size(); ++i) {
        if ((set >> i & 1) != 0) held.push_back(optional[i]);
      }
      std::sort(held.begin(), held.end());
      Impact impact = solver.Solve(held, touching);
      if (impact.consistent) return impact;
    }
  }
  return solver.Solve(must_hold, touching);
}

}  // namespace rollgait
