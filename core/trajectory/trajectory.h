#ifndef ROLLGAIT_CORE_TRAJECTORY_TRAJECTORY_H_
#define ROLLGAIT_CORE_TRAJECTORY_TRAJECTORY_H_

#include <string>
#include <vector>

#include "core/base/types.h"
#include "core/math/scheme.h"

namespace rollgait {

// What a trajectory spans: one step of two, both, or a motion from one state to another that nothing repeats.
enum class Cycle { kHalf, kFull, kOnce };

// One phase. Matrices hold one COLUMN per time (joint order of the model, N + 1 nodes, N·s collocation points).
struct TrajectoryPhase {
  std::vector<int> contacts;  // indices into Scene::contacts, order of the force blocks
  double start = 0;           // s
  double duration = 0;        // s
  std::vector<double> node_times;
  MatrixX node_positions;   // nq × (N+1)
  MatrixX node_velocities;  // nq × (N+1)
  std::vector<double> point_times;
  MatrixX point_positions;  // nq × N·s; these two on the polynomials that Trajectory states
  MatrixX point_velocities;
  MatrixX point_accelerations;
  MatrixX point_efforts;  // n_actuated × N·s
  MatrixX point_forces;   // 3·n_contacts × N·s, N, world axes, on the body
  // Where velocities jump at its start (from the last node of the phase before): impulses of its contacts,
  // 3·n_contacts, N s, world axes, on the body, and the kinetic energy lost, J. Empty where they do not.
  VectorX impulses;
  double impact_loss = 0;
};

// An optimised motion over a half or a full cycle, or once. Within an interval of length h from node (q₀, v₀), with θ =
// (t − t_k)/h: the acceleration is the polynomial of degree s − 1 through the interval's points, v(t) and q(t) are its
// integrals, and efforts and forces are the polynomials of degree s − 1 through theirs. Immutable by convention.
//
// The solver imposes the equations of motion with the point's velocity, acceleration, efforts and forces at the stage
// position of the Runge–Kutta scheme,  q_i = q₀ + h c_i v₀ + h² Σ_j (A²)_ij a_j  with A_ij = ∫₀^{c_i} L_j (Tableau):
// twice the rule of a single integration. q(t) integrates the same accelerations exactly. The two agree at c_i = 0 and
// 1; at the others they differ by O(h^(s+1)), and with them the equations of motion at a point of q(t). Stage positions
// keep the stability of the scheme (docs/explanation/accuracy.md); the difference is part of the error that
// AccuracyReport measures.
//
// Of direct multiple shooting a trajectory is the dense output of its steps, as one of Hermite–Simpson
// (transcription/returned_points.h): the nodes are those of the solver, which imposes the equations of motion at the
// stages of the method.
struct Trajectory {
  Scheme scheme = Scheme::kRadau2;  // a collocation scheme
  int points_per_interval = 2;
  std::vector<double> point_fractions;  // c₁ … c_s of the scheme
  Cycle cycle = Cycle::kHalf;
  double duration = 0;      // s
  double displacement = 0;  // m, along x
  std::vector<TrajectoryPhase> phases;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRAJECTORY_TRAJECTORY_H_
