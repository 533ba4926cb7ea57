#ifndef ROLLGAIT_CORE_TRANSCRIPTION_LINEAR_ROWS_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_LINEAR_ROWS_H_

#include <string>
#include <utility>
#include <vector>

#include "core/math/collocation.h"
#include "core/nlp/problem.h"
#include "core/ocp/problem.h"
#include "core/transcription/layout.h"
#include "core/transcription/row_info.h"

namespace rollgait {

// Rows  lower ≤ Σ coefficient · x ≤ upper  of the NLP.
class LinearRows {
 public:
  struct Row {
    std::string name, unit;
    double lower = 0, upper = 0;                // in unit / size
    std::vector<std::pair<int, double>> terms;  // (unknown, coefficient in unit / size)
    double size = 1;                            // in unit
  };

  void Add(Row row) { rows_.push_back(std::move(row)); }
  int size() const { return static_cast<int>(rows_.size()); }
  void Bounds(double* lower, double* upper) const;
  void AddPattern(int first_row, SparsityPattern* jacobian) const;
  void Values(const double* x, double* g) const;
  void Jacobian(double* values) const;
  RowInfo Describe(int row) const { return {rows_[row].name, rows_[row].unit, rows_[row].size, 0, 0}; }

 private:
  std::vector<Row> rows_;
};

// x_N = mirror(x_0) + displacement along x, without the mirror in a full cycle; of positions alone where the cycle
// starts with a jump.
void AddPeriodicityRows(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows);
// Without periodicity: the displacement is how far the forward joint went, unless it is prescribed.
void AddDisplacementRow(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows);
// Positions do not jump.
void AddJumpPositionRows(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows);
// Range of the mean speed, of the duty factor and of the sum of the durations.
void AddTravelRows(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows);
// In schemes whose intervals share an instant (the first point is a node), efforts and forces whose rate costs
// something are the same on both sides; forces within a phase.
void AddContinuityRows(const OptimalControlProblem& problem, const DecisionLayout& layout,
                       const EliminatedScheme& scheme, LinearRows* rows);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_LINEAR_ROWS_H_
