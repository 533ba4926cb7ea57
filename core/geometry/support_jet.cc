#include "core/geometry/support_jet.h"

#include <algorithm>

namespace rollgait {

void SupportJet::SetThird(const int* ijk, double value) {
  for (int n = 0; n < 3; ++n) {
    const int i = ijk[n], j = ijk[(n + 1) % 3], k = ijk[(n + 2) % 3];
    T[k](i, j) = T[k](j, i) = value;
  }
}

void SupportJet::SetFourth(const int* ijkl, double value) {
  constexpr int kPairs[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {2, 3, 0, 1}, {1, 3, 0, 2}, {1, 2, 0, 3}};
  for (const auto& pair : kPairs) {
    Matrix3& matrix = Q[PairIndex(ijkl[pair[0]], ijkl[pair[1]])];
    const int i = ijkl[pair[2]], j = ijkl[pair[3]];
    matrix(i, j) = matrix(j, i) = value;
  }
}

void SupportJet::MarkMissing(int asked) {
  const auto finite = [](const auto& matrices) {
    return std::all_of(matrices.begin(), matrices.end(), [](const Matrix3& matrix) { return matrix.allFinite(); });
  };
  if (asked >= 2 && order >= 2 && !S.allFinite()) order = 1;
  if (asked >= 3 && order >= 3 && !finite(T)) order = 2;
  if (asked >= 4 && order >= 4 && !finite(Q)) order = 3;
  const Matrix3 missing = Matrix3::Constant(kInfinity);
  if (asked >= 2 && order < 2) S = missing;
  if (asked >= 3 && order < 3) T.fill(missing);
  if (asked >= 4 && order < 4) Q.fill(missing);
}

}  // namespace rollgait
