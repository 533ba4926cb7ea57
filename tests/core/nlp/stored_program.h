#ifndef ROLLGAIT_TESTS_CORE_NLP_STORED_PROGRAM_H_
#define ROLLGAIT_TESTS_CORE_NLP_STORED_PROGRAM_H_

#include "core/nlp/problem.h"

namespace rollgait {

// A program whose sizes, bounds and patterns are what its maker has filled in; its values are left to it.
class StoredProgram : public NlpProblem {
 public:
  int variables() const override { return static_cast<int>(lower_.size()); }
  int constraints() const override { return static_cast<int>(row_lower_.size()); }
  const VectorX& lower_bounds() const override { return lower_; }
  const VectorX& upper_bounds() const override { return upper_; }
  const VectorX& constraint_lower() const override { return row_lower_; }
  const VectorX& constraint_upper() const override { return row_upper_; }
  const SparsityPattern& jacobian_pattern() const override { return jacobian_; }
  const SparsityPattern& hessian_pattern() const override { return hessian_; }

 protected:
  VectorX lower_, upper_, row_lower_, row_upper_;
  SparsityPattern jacobian_, hessian_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_NLP_STORED_PROGRAM_H_
