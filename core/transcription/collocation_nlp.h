#ifndef ROLLGAIT_CORE_TRANSCRIPTION_COLLOCATION_NLP_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_COLLOCATION_NLP_H_

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/nlp/nlp_options.h"
#include "core/nlp/problem.h"
#include "core/nlp/result.h"
#include "core/trajectory/coarse_motion.h"
#include "core/trajectory/sampling.h"
#include "core/transcription/coupling_term.h"
#include "core/transcription/entry_rows.h"
#include "core/transcription/flat_side.h"
#include "core/transcription/interval_block.h"
#include "core/transcription/jump_rows.h"
#include "core/transcription/layout.h"
#include "core/transcription/linear_rows.h"
#include "core/transcription/returned_points.h"

namespace rollgait {

// Where a solve starts: durations, displacement and the motion at a fraction of a phase. Forces are 3 per active
// contact, world; impulses likewise, one vector a phase, empty for zero.
struct MotionGuess {
  std::vector<double> durations;  // s, one a phase
  double displacement = 0;        // m
  std::function<MotionSample(int phase, double fraction)> motion;
  std::vector<VectorX> impulses;  // N s; none: zero
  bool near_solution = false;     // of a problem like this one: the solver stays near it
};

// The optimal control problem on a mesh, as a nonlinear program in stage order (DecisionLayout).
//   rows: interval by interval the rows of its points; entry rows of the phases; jumps; periodicity or displacement;
//   positions through jumps; travel; continuous efforts and forces
// The problem must outlive this object. Not thread-safe; evaluations allocate nothing.
class CollocationNlp : public NlpProblem {
 public:
  CollocationNlp(const OptimalControlProblem& problem, Scheme scheme, const Mesh& mesh, AddedConstraints added = {});
  ~CollocationNlp() override;

  int variables() const override { return layout_.size(); }
  int constraints() const override { return rows_; }
  const VectorX& lower_bounds() const override { return lower_; }
  const VectorX& upper_bounds() const override { return upper_; }
  const VectorX& constraint_lower() const override { return row_lower_; }
  const VectorX& constraint_upper() const override { return row_upper_; }
  const SparsityPattern& jacobian_pattern() const override { return jacobian_pattern_; }
  const SparsityPattern& hessian_pattern() const override { return hessian_pattern_; }
  // Point by point the efforts and the rows that hold them, then the rest of the interval with the node before it; last
  // the first node, the durations and the displacement, which everything may meet.
  EliminationGroups elimination_groups() const override;
  double variable_size(int variable) const override;
  bool Objective(const double* x, double* value) override;
  bool Gradient(const double* x, double* gradient) override;
  bool Constraints(const double* x, double* g) override;
  bool Jacobian(const double* x, double* values) override { return Derivatives(x, 0, nullptr, values, nullptr); }
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override {
    return Derivatives(x, sigma, lambda, nullptr, values);
  }
  // Either of the two may be null.
  bool Derivatives(const double* x, double sigma, const double* lambda, double* jacobian, double* hessian) override;

  const DecisionLayout& layout() const { return layout_; }
  const Mesh& mesh() const { return mesh_; }
  const AddedConstraints& added() const { return added_; }
  // f of the NLP = objective_scale() · (weighted sum of integrals / denominator).
  double objective_scale() const { return objective_scale_; }
  // The order of magnitude of the objective in walking, in its own units.
  double typical_objective() const { return kTypicalScaled / objective_scale_; }

  VectorX MakeStart(const MotionGuess& guess) const;
  // Fills the multipliers of `start` from those of a solution of the same problem on another mesh.
  void TransferMultipliers(const CollocationNlp& from, const NlpResult& of, NlpStart* start) const;
  Trajectory Extract(const double* x);
  // Positions at some of the nodes of each phase; evaluates nothing. At most so many of a phase, >= 2.
  CoarseMotion ExtractCoarse(const double* x, int most_of_a_phase) const;
  // Unweighted integral of every cost term in the order of the problem, and what their weighted sum is divided by.
  VectorX CostIntegrals(const double* x, CostForm form = CostForm::kMinimised);
  double Denominator(const double* x) const;
  double displacement(const double* x) const { return x[layout_.displacement()]; }
  double duration(const double* x) const;

  RowInfo Describe(const double* x, int row) const;
  // The sides of friction pyramids that cost something at a solution with these multipliers (Ipopt's signs).
  std::vector<FlatSide> FlatSides(const double* x, const VectorX& row_multipliers) const;

 private:
  double StepRatio(int interval) const { return layout_.length(interval); }
  double Step(const double* x, int interval) const {
    return x[layout_.duration(layout_.phase(interval))] * StepRatio(interval);
  }
  int GlobalColumn(int interval, int local) const;
  std::vector<double> PointTimes(int phase, int point) const;  // fractions of the phase
  int FirstRow(int interval) const;
  void TransferPoint(const CollocationNlp& from, const NlpResult& of, int p, int i, NlpStart* start) const;
  void TransferPath(const CollocationNlp& from, const NlpResult& of, int p, NlpStart* start) const;
  void TransferNodes(const CollocationNlp& from, const NlpResult& of, NlpStart* start) const;
  void TransferJump(const CollocationNlp& from, const NlpResult& of, int p, NlpStart* start) const;
  TrajectoryPhase ExtractPhase(const double* x, int phase, double start);
  void ExtractImpact(const double* x, int phase, TrajectoryPhase* extracted);
  // Divides the forces of a point that contacts of one link have along x as ForceSharesConstraint asks for.
  void ShareForces(int phase, double* forces) const;
  void SetDenominator();
  void SetStateBounds();
  void TightenNode(int k, const EndBounds& bounds);
  void SetJumpBounds(int phase);
  void SetControlBounds();
  void SetForceBounds(int interval);
  void SetRowBounds();
  void BuildPatterns();
  void AddDenominatorPattern();
  void ScaleObjective();
  // Fills integrals_ and returns their weighted sum.
  double WeightedIntegral(const double* x, CostForm form = CostForm::kMinimised);
  // weights_ = factor · weight of every term.
  void SetWeights(double factor);
  void AddCouplingGradient(const double* x, double* gradient);
  void IntervalDerivatives(const double* x, const double* lambda, double** jacobian, double** hessian);
  double* DenominatorHessian(const double* x, double factor, double* values);

  const OptimalControlProblem& problem_;
  ReturnedPoints returned_;
  EliminatedScheme scheme_;
  Mesh mesh_;
  AddedConstraints added_;
  DecisionLayout layout_;
  PointWorkspace workspace_;
  std::vector<std::unique_ptr<IntervalBlock>> blocks_;   // one a phase
  std::vector<std::unique_ptr<CouplingTerm>> coupling_;  // one a cost term, null for those with an integrand
  EntryRows entries_;
  JumpRows jumps_;
  LinearRows linear_;
  std::vector<int> denominator_;    // unknowns whose sum divides the integrals; empty: nothing
  std::vector<int> cost_unknowns_;  // unknowns with a cost gradient, without the durations
  int rows_ = 0, first_entry_row_ = 0, first_jump_row_ = 0, first_linear_row_ = 0;
  VectorX lower_, upper_, row_lower_, row_upper_;
  SparsityPattern jacobian_pattern_, hessian_pattern_;
  // The scaled objective in walking: the curvature of one node of a fine mesh is well above Ipopt's regularisation.
  static constexpr double kTypicalScaled = 100;
  double objective_scale_ = 1;

  VectorX integrals_, weights_, local_gradient_, cost_gradient_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_COLLOCATION_NLP_H_
