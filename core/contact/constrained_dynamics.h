#ifndef ROLLGAIT_CORE_CONTACT_CONSTRAINED_DYNAMICS_H_
#define ROLLGAIT_CORE_CONTACT_CONSTRAINED_DYNAMICS_H_

#include <Eigen/Cholesky>
#include <vector>

#include "core/base/types.h"
#include "core/contact/contact_surface.h"
#include "core/contact/rolling_kinematics.h"
#include "core/multibody/body_dynamics.h"
#include "core/multibody/tree_factor.h"

namespace rollgait {

// The solution of   M a − Jᵀ λ = f,   J a = r   (docs/explanation/notation.md; eqs (3.8)–(3.10) with the factor ½).
struct ConstrainedSolution {
  VectorX acceleration;  // n
  VectorX forces;        // rows of J; on the body that carries the surface
  int rank = 0;          // of J, in the metric of M⁻¹
  // True if rank < rows. The acceleration is still the right one. The forces are not unique: of all that give this
  // acceleration, those of least norm are returned (each row scaled to unit effective mobility).
  bool redundant = false;
  // How far the rows that count are from depending on each other: the least distance, in the metric of M⁻¹, of one of
  // them (unit length) from the span of those before it, in the order of pivots; 1: all perpendicular; above 1e-10.
  // Rounding ε of poses and velocities costs accelerations ε / independence of their size, forces ε / independence².
  double independence = 1;
  // False if the forces are not unique within rounding: redundant, or so nearly that they have no digit left.
  bool ForcesUnique() const { return !redundant && independence > kForcesLost; }
  static constexpr double kForcesLost = 1.5e-8;  // √ε
  // max |J a − r|, m/s². Rounding level, unless redundant rows contradict each other.
  double residual = 0;
  // False if friction and rigid bodies leave the accelerations undetermined (SolveSliding): then they are NaN.
  bool determined = true;
};

// Solves that system. Allocates only when n or the number of rows grows.
class ConstrainedSolver {
 public:
  // For any M.
  ConstrainedSolver() = default;
  // For the mass matrix of a tree (Model::ColumnParents), of which it uses that unrelated columns do not interact.
  explicit ConstrainedSolver(const std::vector<int>& parents) : tree_(true), factor_(parents) {}

  // Contract: `mass` is symmetric positive definite, J has as many columns. J may have no rows.
  void Solve(const MatrixX& mass, const VectorX& force, const MatrixX& jacobian, const VectorX& right_side,
             ConstrainedSolution* solution);
  // The same with forces that act along other directions than the rows they hold:  M a − Fᵀ λ = f,  J a = r,  as
  // friction that is proportional to a normal force does. Undetermined if a row cannot be held by its own force
  // (Painlevé: pressing harder accelerates the contact into the ground), or if dependent rows have forces that move the
  // tree differently.
  void SolveSliding(const MatrixX& mass, const VectorX& force, const MatrixX& jacobian, const MatrixX& force_jacobian,
                    const VectorX& right_side, ConstrainedSolution* solution);
  // What the last Solve's a and λ change by if f and r do: replaces changes df (n × k) by da and dr (rows × k) by dλ.
  // If rows are redundant, r acts through the rows that were chosen as independent, and λ is the one of least norm.
  // Fastest if k is a multiple of four.
  void Differentiate(RowMajorMatrix* acceleration, RowMajorMatrix* forces);

 private:
  void FactoriseMass(const MatrixX& mass);
  // Orthonormal basis of the columns of A = L⁻ᵀ Jᵀ by pivoted Gram–Schmidt with reorthogonalisation.
  void Factorise();

  bool tree_ = false;
  TreeFactor factor_;       // M = Lᵀ L
  RowMajorMatrix columns_;  // n × (rows, f, and zeros up to a multiple of four)
  MatrixX a_;               // n × rows, columns scaled to unit norm; as q_ and free_ filled to a multiple of four
  MatrixX q_;               // n × rank
  MatrixX r_;               // rank × rows, columns in the order of pivots_
  MatrixX gram_;
  Eigen::LLT<MatrixX> least_norm_;  // of R Rᵀ, if rows are redundant
  RowMajorMatrix chosen_;           // of Differentiate
  VectorX scale_, free_, right_, z_, forces_;
  std::vector<int> pivots_;
  int rank_ = 0;
};

// Correction of drift, per contact: n·ẇ = −2ζΩ φ̇ − Ω² φ and t·ẇ = −κ t·w instead of ẇ = 0. All zero: off.
struct Baumgarte {
  double frequency = 0;  // Ω, 1/s
  double damping = 0;    // ζ
  double slip_rate = 0;  // κ, 1/s
};

// Forward dynamics of a tree on rolling contacts that are held at acceleration level, ẇ = 0: gap and slip of the
// initial state are carried on (the gap's acceleration is zero, too), not corrected, unless Baumgarte terms are given.
// Bilateral: forces may pull, and friction has no limit. Not thread-safe: one object a thread.
// Simulation has the general ContactDynamics. This one stays beside it because trajectories are judged with it: it
// takes contacts with the ground from RollingKinematics and shares with ContactDynamics only the solver above.
class ConstrainedDynamics {
 public:
  // `surfaces` are the active contacts. Copies what it needs of them and of the dynamics' model.
  ConstrainedDynamics(const BodyDynamics& dynamics, std::vector<ContactSurface> surfaces, Baumgarte baumgarte = {});

  // Evaluates at (q, v) with the generalized forces τ (n, N m or N; zero for joints that are not actuated).
  // The result is valid until the next call. `forces` has a row per direction of each surface.
  const ConstrainedSolution& Evaluate(const VectorX& q, const VectorX& v, const VectorX& tau, const Vector3& gravity);

  // Of the last Evaluate.
  const BodyDynamics::State& state() const { return state_; }
  const RollingContact& contact(int k) const { return contacts_[k]; }
  // Force of the ground on surface k, N, world axes; zero in directions that the contact does not transmit.
  Vector3 Force(int k) const;

 private:
  BodyDynamics dynamics_;
  std::vector<ContactSurface> surfaces_;
  std::vector<int> first_row_;
  Baumgarte baumgarte_;
  BodyDynamics::State state_;
  BodyDynamics::Workspace workspace_;
  std::vector<RollingContact> contacts_;
  MatrixX mass_, jacobian_;
  VectorX bias_, force_, right_side_;
  ConstrainedSolver solver_;
  ConstrainedSolution solution_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONSTRAINED_DYNAMICS_H_
