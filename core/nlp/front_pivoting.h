#ifndef ROLLGAIT_CORE_NLP_FRONT_PIVOTING_H_
#define ROLLGAIT_CORE_NLP_FRONT_PIVOTING_H_

namespace rollgait {

// The dense kernel of FrontalLdlt: the fully summed columns of one front, column-major. Fastest where every column
// starts a line of the cache. The first `columns` rows belong to the columns themselves; that square block is symmetric
// and stored in full.
struct FrontPanel {
  int rows, columns, stride;
  double* l;   // in: the columns of A; out: the first pivots columns hold L, unit lower, zero inside a pivot of order 2
  double* ld;  // out: the first pivots columns hold L D; same shape
  double* diagonal;  // out, columns: D
  double* coupling;  // in: zero; out: off-diagonal of a pivot of order 2 at its first column
  int* unknowns;     // rows; exchanged with the columns
  int* updated;      // columns: scratch, the number of pivots that a column has seen
};

struct FrontPivots {
  int count = 0;     // pivots found; columns count … columns − 1 are left over, up to date with all pivots
  int negative = 0;  // negative eigenvalues of D
};

// Eliminates as many columns as have an acceptable pivot (see FrontalLdlt::Factorise for the threshold).
FrontPivots EliminateFront(const FrontPanel& panel, double threshold);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_FRONT_PIVOTING_H_
