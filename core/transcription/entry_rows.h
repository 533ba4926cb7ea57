#ifndef ROLLGAIT_CORE_TRANSCRIPTION_ENTRY_ROWS_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_ENTRY_ROWS_H_

#include <memory>
#include <vector>

#include "core/nlp/problem.h"
#include "core/ocp/problem.h"
#include "core/transcription/layout.h"
#include "core/transcription/point_workspace.h"
#include "core/transcription/row_info.h"

namespace rollgait {

// The rows at the first node of every phase (OptimalControlProblem::EntryConstraints), functions of its (q, v). Layout
// and workspace must outlive the object. Evaluations allocate nothing.
class EntryRows {
 public:
  EntryRows(const OptimalControlProblem& problem, const DecisionLayout& layout, PointWorkspace* workspace);

  int size() const { return size_; }
  void Bounds(double* lower, double* upper) const;
  void AddPatterns(int first_row, SparsityPattern* jacobian, SparsityPattern* hessian) const;
  void Values(const double* x, double* g);
  // These return the end of what they wrote.
  double* Jacobian(const double* x, double* values);
  double* Hessian(const double* x, const double* lambda, double* values);
  RowInfo Describe(const double* x, int row) const;

 private:
  struct Entry {
    std::unique_ptr<PointConstraint> constraint;
    int node, phase;
    Entries jacobian, hessian;
  };
  void Load(const double* x, int node, bool second);

  const DecisionLayout& layout_;
  PointWorkspace* workspace_;
  int n_, size_ = 0;
  std::vector<Entry> entries_;
  PointContext context_;
  VectorX z_, lambda_;
  MatrixX jacobian_, hessian_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_ENTRY_ROWS_H_
