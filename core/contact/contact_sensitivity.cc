#include "core/contact/contact_sensitivity.h"

#include <tuple>

#include "core/multibody/configuration.h"

namespace rollgait {
namespace {

// Weights of f(k h) − f(−k h), k = 1 … 4, of order 8, and a step at which truncation and rounding are alike.
constexpr double kWeights[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
constexpr double kStep = 5e-3;

class SensitivitySolver {
 public:
  SensitivitySolver(const Model& model, const VectorX& tau, const Vector3& gravity,
                    const std::vector<FrameMotion>& ground, const std::vector<int>& active, const Baumgarte& baumgarte,
                    ContactDynamics* dynamics)
      : model_(model), tau_(tau), gravity_(gravity), ground_(ground), active_(active), baumgarte_(baumgarte),
        dynamics_(*dynamics) {}

  ContactSensitivity Solve(const VectorX& q, const VectorX& v) {
    dynamics_.SetState(q, v, ground_);
    const ConstrainedSolution& solution = dynamics_.Accelerate(active_, tau_, gravity_, baumgarte_);
    acceleration_ = solution.acceleration;
    forces_ = solution.forces;
    ContactSensitivity sensitivity;
    sensitivity.redundant = solution.redundant;

    const int nv = model_.nv(), rows = static_cast<int>(forces_.size());
    MatrixX along_q(nv + rows, nv), along_v(nv + rows, nv), along_tau = MatrixX::Zero(nv + rows, nv);
    for (int j = 0; j < nv; ++j) {
      const VectorX unit = VectorX::Unit(nv, j);
      along_q.col(j) = Slope([&](double h) { return Residual(Retract(model_, q, h * unit), v); });
      along_v.col(j) = Slope([&](double h) { return Residual(q, v + h * unit); });
    }
    along_tau.topRows(nv) = -MatrixX::Identity(nv, nv);

    dynamics_.SetState(q, v, ground_);
    VectorX right;
    dynamics_.AccelerationRows(active_, baumgarte_, &jacobian_, &right);
    const MatrixX mass = dynamics_.MassMatrix();
    for (const auto& [residual, acceleration, forces] :
         {std::tuple(&along_q, &sensitivity.acceleration_q, &sensitivity.forces_q),
          std::tuple(&along_v, &sensitivity.acceleration_v, &sensitivity.forces_v),
          std::tuple(&along_tau, &sensitivity.acceleration_tau, &sensitivity.forces_tau)}) {
      acceleration->resize(nv, nv);
      forces->resize(rows, nv);
      for (int j = 0; j < nv; ++j) {
        solver_.Solve(mass, -residual->col(j).head(nv), jacobian_, -residual->col(j).tail(rows), &change_);
        acceleration->col(j) = change_.acceleration;
        forces->col(j) = change_.forces;
      }
    }
    return sensitivity;
  }

 private:
  template <typename F>
  VectorX Slope(F value) const {
    VectorX slope = VectorX::Zero(model_.nv() + forces_.size());
    for (int k = 1; k <= 4; ++k) slope += kWeights[k - 1] / kStep * (value(k * kStep) - value(-k * kStep));
    return slope;
  }

  // ID(q, v, a) − τ − Jᵀλ and J a − r at fixed a, λ, τ.
  VectorX Residual(const VectorX& q, const VectorX& v) {
    dynamics_.SetState(q, v, ground_);
    VectorX right, needed;
    dynamics_.AccelerationRows(active_, baumgarte_, &jacobian_, &right);
    dynamics_.dynamics().InverseDynamics(dynamics_.state(), acceleration_, gravity_, &workspace_, &needed);
    VectorX residual(model_.nv() + forces_.size());
    residual << needed - tau_ - jacobian_.transpose() * forces_, jacobian_ * acceleration_ - right;
    return residual;
  }

  const Model& model_;
  const VectorX& tau_;
  const Vector3& gravity_;
  const std::vector<FrameMotion>& ground_;
  const std::vector<int>& active_;
  const Baumgarte& baumgarte_;
  ContactDynamics& dynamics_;
  BodyDynamics::Workspace workspace_;
  ConstrainedSolver solver_;
  ConstrainedSolution change_;
  VectorX acceleration_, forces_;
  MatrixX jacobian_;
};

}  // namespace

ContactSensitivity ComputeSensitivity(const Model& model, const VectorX& q, const VectorX& v, const VectorX& tau,
                                      const Vector3& gravity, const std::vector<FrameMotion>& ground,
                                      const std::vector<int>& active, const Baumgarte& baumgarte,
                                      ContactDynamics* dynamics) {
  return SensitivitySolver(model, tau, gravity, ground, active, baumgarte, dynamics).Solve(q, v);
}

}  // namespace rollgait
