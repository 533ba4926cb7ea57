#ifndef ROLLGAIT_CORE_NLP_SUBTRACT_PRODUCTS_H_
#define ROLLGAIT_CORE_NLP_SUBTRACT_PRODUCTS_H_

namespace rollgait {

// The inner loop of dense elimination:
// y (n) −= Σ_k l_k w_k for `count` columns l_k (each `l_stride` after the last one) and numbers w_k (`w_stride` apart).
// Columns whose number is zero are passed over. Runs with AVX2 and FMA where the processor has them, so the last bits of a result
// depend on the kind of processor.
void SubtractProducts(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_SUBTRACT_PRODUCTS_H_
