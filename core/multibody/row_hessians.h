#ifndef ROLLGAIT_CORE_MULTIBODY_ROW_HESSIANS_H_
#define ROLLGAIT_CORE_MULTIBODY_ROW_HESSIANS_H_

#include "core/base/types.h"

namespace rollgait {

// Second derivatives of the rows of inverse dynamics τ = ID(q, v, a): for each row l four n × n matrices, next to each
// other in n × n² matrices. qq = ∂²τ_l/∂q² and vv = ∂²τ_l/∂v² are symmetric and full, qv(i, j) = ∂²τ_l/∂q_i ∂v_j, qa(i,
// j) = ∂²τ_l/∂q_i ∂a_j. The others are zero. Units: those of τ_l divided by those of the two variables.
struct RowHessians {
  explicit RowHessians(int size) : n(size), qq(MatrixX::Zero(n, n * n)), qv(qq), qa(qq), vv(qq) {}
  // The matrix of row l, of one of the four.
  auto Row(const MatrixX& all, int l) const { return all.middleCols(l * n, n); }

  int n;
  MatrixX qq, qv, qa, vv;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_ROW_HESSIANS_H_
