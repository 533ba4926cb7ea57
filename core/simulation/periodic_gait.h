#ifndef ROLLGAIT_CORE_SIMULATION_PERIODIC_GAIT_H_
#define ROLLGAIT_CORE_SIMULATION_PERIODIC_GAIT_H_

#include <Eigen/Core>
#include <functional>

#include "core/base/result.h"
#include "core/base/stop.h"
#include "core/simulation/scene_dynamics.h"
#include "core/simulation/simulation.h"

namespace rollgait {

struct PeriodicGaitOptions {
  double residual = 1e-12;  // largest |P(s) − s| that ends the search; coordinates in rad, m, rad/s, m/s
  int max_iterations = 40;
  double difference_step = 1e-4;  // of the sixth-order differences that make the Jacobian of the step map
};

// A one-step periodic gait: the state right after heel strike, with legs relabelled, that a step maps to itself.
struct PeriodicGait {
  bool converged = false;
  int iterations = 0;
  double residual = 0;
  VectorX q, v;                  // the fixed point, all joints of the scene
  double period = 0;             // s
  double step_length = 0;        // m or rad, change of the travel joint
  MatrixX jacobian;              // of the step map, d × d, in the coordinates of GaitSection(scene, q)
  Eigen::VectorXcd eigenvalues;  // largest magnitude first
  SimulationEvent heel_strike;   // of the periodic step, before relabelling
  SimulationReport report;       // of the periodic step
};

// The states right after heel strike: the active contacts of the scene and their mirror images touch, the active ones
// do not slip; the position of the travel joint does not count. Coordinates y ∈ R^d near a state of it: components of
// position and velocity along an orthonormal basis of its tangent space. Fixed ground; joints with one degree of
// freedom.
class GaitSection {
 public:
  // Around positions near those of the section; they are moved onto it. The scene outlives the section.
  GaitSection(const SimulationScene& scene, const VectorX& q);

  int dimension() const { return static_cast<int>(position_basis_.cols() + velocity_basis_.cols()); }
  // Coordinates of a state of the section, and the state with given coordinates.
  VectorX Coordinates(const VectorX& q, const VectorX& v) const;
  void State(const VectorX& y, VectorX* q, VectorX* v);

 private:
  void Gaps(const VectorX& q, VectorX* gaps, MatrixX* jacobian);
  MatrixX SlipRows(const VectorX& q);
  // q + normals z with all gaps zero.
  VectorX Close(VectorX q);

  SceneDynamics dynamics_;
  std::vector<int> touching_;
  VectorX origin_;
  MatrixX position_basis_, position_normals_, velocity_basis_, velocity_normals_;
};

// Called after each Newton iteration; false ends the search.
using PeriodicGaitObserver = std::function<bool(int iteration, double residual)>;

// Newton's method on the step map P(s) − s from the scene's state at t = 0 (right after a heel strike, approximately),
// with the scene's mirror and travel joint. A step ends at the first touch-down; options.duration of the scene bounds
// it, its tolerance (at most 1e-13 is used) governs the integration. Violations: what the scene lacks, or that no step
// ends in a heel strike near the start. A search that does not converge is a result with converged = false.
Result<PeriodicGait> FindPeriodicGait(const SimulationScene& scene, const PeriodicGaitOptions& options,
                                      const PeriodicGaitObserver& observer = {}, const StopFlag* stop = nullptr);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_PERIODIC_GAIT_H_
