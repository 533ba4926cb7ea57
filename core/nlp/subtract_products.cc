#include "core/nlp/subtract_products.h"

#include <cstddef>
#include <type_traits>

namespace rollgait {
namespace {

// What is inlined into a function takes that function's instruction set.
#define ROLLGAIT_INLINE inline __attribute__((always_inline))

// y −= Σ f_k l_k over K columns.
template <int K>
ROLLGAIT_INLINE void Subtract(const double* const* columns, const double* f, int n, double* __restrict y) {
  const double* l[K];
  double factor[K];
  for (int k = 0; k < K; ++k) {
    l[k] = columns[k];
    factor[k] = f[k];
  }
  for (int i = 0; i < n; ++i) {
    double sum = y[i];
    for (int k = 0; k < K; ++k) sum -= l[k][i] * factor[k];
    y[i] = sum;
  }
}

ROLLGAIT_INLINE void SubtractAll(const double* l, int l_stride, const double* w, int w_stride, int count, int n,
                                 double* y) {
  constexpr int kMost = 8;
  const double* columns[kMost];
  double factors[kMost];
  int used = 0;
  for (int k = 0; k < count; ++k) {
    const double factor = w[static_cast<size_t>(k) * w_stride];
    if (factor == 0) continue;
    columns[used] = l + static_cast<size_t>(k) * l_stride;
    factors[used] = factor;
    if (++used < kMost) continue;
    Subtract<kMost>(columns, factors, n, y);
    used = 0;
  }
  if ((used & 4) != 0) Subtract<4>(columns, factors, n, y);
  const int done = used & 4;
  if ((used & 2) != 0) Subtract<2>(columns + done, factors + done, n, y);
  if ((used & 1) != 0) Subtract<1>(columns + used - 1, factors + used - 1, n, y);
}

using Kernel = void (*)(const double*, int, const double*, int, int, int, double*);

void Portable(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y) {
  SubtractAll(l, l_stride, w, w_stride, count, n, y);
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void Wide(const double* l, int l_stride, const double* w, int w_stride, int count,
                                              int n, double* y) {
  SubtractAll(l, l_stride, w, w_stride, count, n, y);
}

Kernel Choose() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? Wide : Portable; }
#else
Kernel Choose() { return Portable; }
#endif

}  // namespace

void SubtractProducts(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y) {
  static const Kernel kernel = Choose();
  kernel(l, l_stride, w, w_stride, count, n, y);
}

}  // namespace rollgait
