#ifndef ROLLGAIT_CORE_TRANSCRIPTION_INTERVAL_BLOCK_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_INTERVAL_BLOCK_H_

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/math/collocation.h"
#include "core/ocp/problem.h"
#include "core/transcription/interval_path_rows.h"
#include "core/transcription/point_workspace.h"

namespace rollgait {

// All collocation points of one interval of a phase, as a function of the slice of unknowns from the node before it to
// the node after it (local variables, scaled) and of its length h (the last local variable, in s). Position, velocity
// and acceleration at a point are linear in the slice for given h; this class carries the derivatives of the point
// functions through that map:
//   ∂g/∂y = Σ c_α J_α,   ∂²ℓ/∂y∂y' = Σ c_α c_β H_αβ,   and the terms of h.
// Second derivatives that involve accelerations are with positions or accelerations, not with velocities or efforts: so
// it is in rigid-body dynamics and with costs of the acceleration.
class IntervalBlock {
 public:
  IntervalBlock(const OptimalControlProblem& problem, const AddedConstraints& added, int phase,
                const EliminatedScheme& scheme, PointWorkspace* workspace);

  int local_size() const { return local_size_; }  // without h
  int rows() const { return rows_; }
  // The rows of the points come first, then those between them.
  const IntervalPathRows& path() const { return *path_; }
  int FirstPathRow() const { return rows_ - path_->size(); }
  // Rows of point i: how many, and the first of them.
  int PointRows(int i) const { return points_[i].rows; }
  int FirstRow(int i) const { return points_[i].first_row; }
  const VectorX& scale() const { return scale_; }                        // physical = scale · unknown, local_size()
  const Entries& jacobian_pattern() const { return jacobian_pattern_; }  // column local_size() is h
  const Entries& hessian_pattern() const { return hessian_pattern_; }    // lower triangle, h included
  // The entries of both that have h: of the Hessian in its row, the one in its column last.
  const std::vector<int>& jacobian_step_entries() const { return jacobian_step_entries_; }
  const std::vector<int>& hessian_step_entries() const { return hessian_step_entries_; }
  // Local variables (h excluded) on which the cost depends.
  const std::vector<int>& cost_variables() const { return cost_variables_; }

  // Bounds of the (scaled) rows of an interval that starts at a fraction of the phase and is as long as another.
  void Bounds(double start, double length, const IntervalPlace& place, double* lower, double* upper) const;
  // What row `row` is: name, unit, natural size and point; of rows between points the last point.
  struct RowInfo {
    std::string name, unit;
    double size;
    int point;
  };
  RowInfo Describe(int row) const;

  // integrals (one per cost term; those without an integrand are left alone) are added to.
  void Integrals(const double* y, double h, CostForm form, double* integrals);
  // gradient (local_size() + 1) = ∂/∂(y, h) of Σ_t weights[t] · integral_t.
  void CostGradient(const double* y, double h, const double* weights, Eigen::Ref<VectorX> gradient);
  void Values(const double* y, double h, double* g);
  // The Jacobian on jacobian_pattern() and the Hessian of λᵀ g + Σ_t weights[t] integral_t on hessian_pattern(); either
  // may be null and is then left out. cost_gradient as CostGradient, with the Hessian only.
  void Derivatives(const double* y, double h, const double* lambda, const double* weights, double* jacobian,
                   double* hessian, Eigen::Ref<VectorX> cost_gradient);

  // State of point i: z = (q, v, a, τ, f).
  const VectorX& PointState(const double* y, double h, int i);

 private:
  struct Point {
    std::vector<PointConstraint*> constraints;
    int first_row = 0;
    int rows = 0;
    bool goes_on_rolling = false;  // contacts have rows of accelerations
    VectorX row_factor;            // 1 / natural size
    // Jacobian entries of (q, v, a): row, coordinate, source; of (τ, f): (row, z index).
    struct StateEntry {
      int row, coordinate, source;
    };
    std::vector<StateEntry> state_entries;
    Entries control_entries;
    std::vector<int> dense_rows;  // rows with an entry in column h
    MatrixX jacobian;             // rows × z-size; zero outside the patterns of the constraints
  };

  void SetStep(double h);
  void LoadPoint(const double* y, int i);
  void UpdateWorkspace(int i, bool dynamics, bool second);
  void EvaluateJacobian(Point* point);
  double* WriteJacobian(int i, double* values);
  void ClearLocal();
  void EvaluateHessian(int i, double h, const double* lambda, const double* weights);
  void BuildPoints();
  void BuildPath(const AddedConstraints& added);
  void BuildJacobianPattern();
  void BuildHessianPattern();
  std::vector<int> Behind(int i, int column) const;
  void PointPairs(int i, Entries* pairs, std::set<int>* step_coupled);
  int SourceOffset(int source) const;
  int ControlOffset(int point) const { return 2 * layout_.n + (points_count_ - 2) * layout_.n + point * controls_; }
  void AccumulateHessian(int i);
  void AccumulateStates(int i);
  void AccumulateAccelerations(int i);
  void AccumulateStep(int i);

  const OptimalControlProblem& problem_;
  int phase_;
  const EliminatedScheme& scheme_;
  PointWorkspace* workspace_;
  PointLayout layout_;
  int points_count_, controls_, local_size_, rows_ = 0;
  std::vector<std::unique_ptr<PointConstraint>> regular_, at_node_;
  std::vector<PointCost*> costs_;  // one per cost term, null for a CouplingTerm
  std::vector<int> active_contacts_;
  std::vector<Point> points_;
  VectorX scale_;
  std::unique_ptr<IntervalPathRows> path_;
  Entries jacobian_pattern_, hessian_pattern_;
  std::vector<int> jacobian_step_entries_, hessian_step_entries_;
  std::vector<int> cost_variables_;

  // Coefficients for the current h: [kind](point, source).
  double step_ = -1;
  MatrixX value_[3], first_[3], second_[3];
  MatrixX scaled_[3];  // value_ times the unit of the source
  PointContext context_;
  VectorX z_, z_rate_, z_curve_;  // z and the first two derivatives of its first 3n entries by h
  MatrixX hessian_;
  bool bends_accelerations_ = false;     // something has second derivatives by accelerations alone
  MatrixX aa_;                           // those, if so
  MatrixX qq_, qv_, vq_, qa_, aq_, vv_;  // blocks of hessian_ and their transposes
  std::vector<int> hessian_place_;       // per entry of hessian_pattern_: of it in local_
  std::vector<double> hessian_scale_;    // likewise
  VectorX gradient_, cost_gradient_, scaled_lambda_, row_rates_;
  MatrixX local_;          // dense lower Hessian of the interval
  MatrixX block_;          // n × controls
  VectorX turned_;         // 3n
  VectorX step_controls_;  // controls
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_INTERVAL_BLOCK_H_
