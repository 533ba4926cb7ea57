#ifndef ROLLGAIT_CORE_TRANSCRIPTION_JUMP_ROWS_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_JUMP_ROWS_H_

#include <memory>
#include <utility>
#include <vector>

#include "core/nlp/problem.h"
#include "core/ocp/problem.h"
#include "core/transcription/layout.h"
#include "core/transcription/point_workspace.h"
#include "core/transcription/row_info.h"

namespace rollgait {

// The rows of every jump of velocities (OptimalControlProblem::JumpConstraints), functions of the node after it, the
// velocities before it and its impulses. Before the first phase of a periodic motion are the velocities of its last
// node, mirrored in a half cycle. Layout and workspace must outlive the object. Evaluations allocate nothing.
class JumpRows {
 public:
  JumpRows(const OptimalControlProblem& problem, const DecisionLayout& layout, PointWorkspace* workspace);

  int size() const { return size_; }
  void Bounds(double* lower, double* upper) const;
  void AddPatterns(int first_row, SparsityPattern* jacobian, SparsityPattern* hessian) const;
  void Values(const double* x, double* g);
  // These return the end of what they wrote.
  double* Jacobian(const double* x, double* values);
  double* Hessian(const double* x, const double* lambda, double* values);
  RowInfo Describe(const double* x, int row) const;
  // Kinetic energy before less that after the jump of a phase that has one, J.
  double EnergyLoss(const double* x, int phase);

 private:
  // z = Σ factor · x[unknown].
  struct Share {
    int unknown;
    double factor;
  };
  struct JacobianEntry {
    int row, column, unknown;
    double factor;
  };
  struct HessianEntry {
    int row, column;      // of z
    int greater, lesser;  // unknowns
    double factor;
  };
  struct Jump {
    int phase = 0, rows = 0;
    std::vector<std::unique_ptr<PointConstraint>> constraints;
    std::vector<std::vector<Share>> behind;  // per entry of z; none of v
    VectorX row_factor;                      // 1 / natural size
    std::vector<JacobianEntry> jacobian;
    std::vector<HessianEntry> hessian;
    VectorX z;
    MatrixX dense_jacobian, dense_hessian;
  };
  void Link(const OptimalControlProblem& problem, Jump* jump) const;
  void AddEntries(Jump* jump) const;
  void Load(const double* x, Jump* jump, bool second);

  const DecisionLayout& layout_;
  PointWorkspace* workspace_;
  int n_, size_ = 0;
  std::vector<Jump> jumps_;
  PointContext context_;
  VectorX lambda_, momentum_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_JUMP_ROWS_H_
