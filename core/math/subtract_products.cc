#include "core/math/subtract_products.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace rollgait {
namespace {

// What is inlined into a function takes that function's instruction set.
#define ROLLGAIT_INLINE inline __attribute__((always_inline))

// Numbers that one instruction works on. Without AVX or AVX-512 the compiler makes several of one.
typedef double Lanes __attribute__((vector_size(4 * sizeof(double))));
typedef double WideLanes __attribute__((vector_size(8 * sizeof(double))));
template <typename L>
constexpr int kWidth = sizeof(L) / sizeof(double);

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

// Columns places[k], or without places all from the first.
ROLLGAIT_INLINE void ColumnKernel(const double* l, int l_stride, const int* places, const double* w, int w_stride,
                                  int count, int n, double* y) {
  constexpr int kMost = 8;
  const double* columns[kMost];
  double factors[kMost];
  int used = 0;
  for (int k = 0; k < count; ++k) {
    const double factor = w[static_cast<size_t>(k) * w_stride];
    if (factor == 0) continue;
    columns[used] = l + static_cast<size_t>(places == nullptr ? k : places[k]) * l_stride;
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

// A tile of R · kWidth<L> rows and C columns of Y, held in registers while all k go by. W's numbers of the columns are
// neighbours.
template <typename L, int R, int C>
ROLLGAIT_INLINE void Tile(const double* l, int l_stride, const double* w, int w_stride, int count, double* y,
                          int y_stride) {
  L sum[R][C];
  for (int c = 0; c < C; ++c) {
    for (int r = 0; r < R; ++r)
      std::memcpy(&sum[r][c], y + static_cast<size_t>(c) * y_stride + r * kWidth<L>, sizeof(L));
  }
  for (int k = 0; k < count; ++k, l += l_stride, w += w_stride) {
    L column[R];
    for (int r = 0; r < R; ++r) std::memcpy(&column[r], l + r * kWidth<L>, sizeof(L));
    for (int c = 0; c < C; ++c) {
      for (int r = 0; r < R; ++r) sum[r][c] -= column[r] * w[c];
    }
  }
  for (int c = 0; c < C; ++c) {
    for (int r = 0; r < R; ++r)
      std::memcpy(y + static_cast<size_t>(c) * y_stride + r * kWidth<L>, &sum[r][c], sizeof(L));
  }
}

// Tiles of R · kWidth<L> rows from row i on, as many as fit.
template <typename L, int R, int C>
ROLLGAIT_INLINE void Tiles(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y,
                           int y_stride, int* i) {
  constexpr int kRows = R * kWidth<L>;
  for (; *i + kRows <= n; *i += kRows) Tile<L, R, C>(l + *i, l_stride, w, w_stride, count, y + *i, y_stride);
}

template <typename L, int C>
ROLLGAIT_INLINE void Rows(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y,
                          int y_stride) {
  int i = 0;
  Tiles<L, 3, C>(l, l_stride, w, w_stride, count, n, y, y_stride, &i);
  Tiles<L, 1, C>(l, l_stride, w, w_stride, count, n, y, y_stride, &i);
  if constexpr (kWidth < L >> kWidth<Lanes>) Tiles<Lanes, 1, C>(l, l_stride, w, w_stride, count, n, y, y_stride, &i);
  for (; i < n; ++i) {
    double sum[C];
    for (int c = 0; c < C; ++c) sum[c] = y[static_cast<size_t>(c) * y_stride + i];
    for (int k = 0; k < count; ++k) {
      const double value = l[static_cast<size_t>(k) * l_stride + i];
      for (int c = 0; c < C; ++c) sum[c] -= value * w[static_cast<size_t>(k) * w_stride + c];
    }
    for (int c = 0; c < C; ++c) y[static_cast<size_t>(c) * y_stride + i] = sum[c];
  }
}

// C columns at a time from column j on, as many as fit; of column j the rows from j · first_step on.
template <typename L, int C>
ROLLGAIT_INLINE void Columns(const double* l, int l_stride, const double* w, int w_stride, int count, int n,
                             int columns, double* y, int y_stride, int first_step, int* j) {
  for (; *j + C <= columns; *j += C) {
    const int first = *j * first_step;
    Rows<L, C>(l + first, l_stride, w + *j, w_stride, count, n - first, y + static_cast<size_t>(*j) * y_stride + first,
               y_stride);
  }
}

template <typename L>
ROLLGAIT_INLINE void MatrixKernel(const double* l, int l_stride, const double* w, int w_stride, int count, int n,
                                  int columns, double* y, int y_stride, int first_step) {
  int j = 0;
  // AVX-512 has registers for twice as many columns, which halves what is read of L.
  if constexpr (kWidth < L >> kWidth<Lanes>) {
    Columns<L, 8>(l, l_stride, w, w_stride, count, n, columns, y, y_stride, first_step, &j);
  }
  Columns<L, 4>(l, l_stride, w, w_stride, count, n, columns, y, y_stride, first_step, &j);
  Columns<L, 1>(l, l_stride, w, w_stride, count, n, columns, y, y_stride, first_step, &j);
}

template <int K>
ROLLGAIT_INLINE void Dots(const double* l, int l_stride, int n, const double* x, double* y) {
  Lanes sum[K] = {};
  int i = 0;
  for (; i + kWidth<Lanes> <= n; i += kWidth<Lanes>) {
    Lanes value;
    std::memcpy(&value, x + i, sizeof(Lanes));
    for (int k = 0; k < K; ++k) {
      Lanes column;
      std::memcpy(&column, l + static_cast<size_t>(k) * l_stride + i, sizeof(Lanes));
      sum[k] += column * value;
    }
  }
  for (int k = 0; k < K; ++k) {
    double total = (sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3]);
    for (int r = i; r < n; ++r) total += l[static_cast<size_t>(k) * l_stride + r] * x[r];
    y[k] -= total;
  }
}

ROLLGAIT_INLINE void TransposedKernel(const double* l, int l_stride, int count, int n, const double* x, double* y) {
  constexpr int kColumns = 4;
  int k = 0;
  for (; k + kColumns <= count; k += kColumns)
    Dots<kColumns>(l + static_cast<size_t>(k) * l_stride, l_stride, n, x, y + k);
  for (; k < count; ++k) Dots<1>(l + static_cast<size_t>(k) * l_stride, l_stride, n, x, y + k);
}

// most = max(most, value), and most where value is no number.
template <typename L>
ROLLGAIT_INLINE void Raise(const L& value, L* most) {
  *most = value > *most ? value : *most;
}

template <typename L>
ROLLGAIT_INLINE void RaiseByMagnitudes(const double* x, L* most) {
  L value;
  std::memcpy(&value, x, sizeof(L));
  value = value < 0 ? -value : value;
  Raise(value, most);
}

template <typename L>
ROLLGAIT_INLINE double LargestKernel(const double* x, int n) {
  // Several at once, because each waits for its last comparison.
  constexpr int kChains = 4;
  L most[kChains] = {};
  int i = 0;
  for (; i + kChains * kWidth<L> <= n; i += kChains * kWidth<L>) {
    for (int s = 0; s < kChains; ++s) RaiseByMagnitudes(x + i + s * kWidth<L>, &most[s]);
  }
  for (; i + kWidth<L> <= n; i += kWidth<L>) RaiseByMagnitudes(x + i, &most[0]);
  for (int s = 1; s < kChains; ++s) Raise(most[s], &most[0]);
  double largest[2] = {};
  for (int k = 0; k < kWidth<L>; ++k) Raise(static_cast<double>(most[0][k]), &largest[k % 2]);
  for (; i < n; ++i) RaiseByMagnitudes(x + i, &largest[i % 2]);
  return std::max(largest[0], largest[1]);
}

ROLLGAIT_INLINE void ScaleKernel(double factor, int n, double* __restrict x, double* __restrict kept) {
  for (int i = 0; i < n; ++i) {
    kept[i] = x[i];
    x[i] *= factor;
  }
}

// The five kernels for one instruction set, with tiles of lanes L. Each number of a tile is summed in the same order
// whatever the lanes; g++ 12 makes the same bits of it with AVX2 and AVX-512, g++ 14 fuses the wide ones only.
#define ROLLGAIT_KERNELS(NAME, TARGET, L)                                                                              \
  TARGET void NAME##Column(const double* l, int l_stride, const int* places, const double* w, int w_stride, int count, \
                           int n, double* y) {                                                                         \
    ColumnKernel(l, l_stride, places, w, w_stride, count, n, y);                                                       \
  }                                                                                                                    \
  TARGET void NAME##Matrix(const double* l, int l_stride, const double* w, int w_stride, int count, int n,             \
                           int columns, double* y, int y_stride, int first_step) {                                     \
    MatrixKernel<L>(l, l_stride, w, w_stride, count, n, columns, y, y_stride, first_step);                             \
  }                                                                                                                    \
  TARGET void NAME##Transposed(const double* l, int l_stride, int count, int n, const double* x, double* y) {          \
    TransposedKernel(l, l_stride, count, n, x, y);                                                                     \
  }                                                                                                                    \
  TARGET double NAME##Largest(const double* x, int n) { return LargestKernel<L>(x, n); }                               \
  TARGET void NAME##Scale(double factor, int n, double* x, double* kept) { ScaleKernel(factor, n, x, kept); }          \
  [[maybe_unused]] constexpr ProductKernels k##NAME = {#NAME,         NAME##Column, NAME##Matrix, NAME##Transposed,    \
                                                       NAME##Largest, NAME##Scale};

ROLLGAIT_KERNELS(Portable, , Lanes)
#if defined(__x86_64__)
ROLLGAIT_KERNELS(Avx2, __attribute__((target("avx2,fma"))), Lanes)
ROLLGAIT_KERNELS(Wide, __attribute__((target("avx512f,avx2,fma"))), WideLanes)
// Dot products are bound by memory: nothing is gained by wider ones.
constexpr ProductKernels kAvx512 = {"Avx512", WideColumn, WideMatrix, Avx2Transposed, WideLargest, WideScale};
#endif

const ProductKernels& Chosen() {
  static const ProductKernels& kernels = *AvailableProductKernels().back();
  return kernels;
}

}  // namespace

std::vector<const ProductKernels*> AvailableProductKernels() {
  std::vector<const ProductKernels*> available = {&kPortable};
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) available.push_back(&kAvx2);
  if (avx2 && __builtin_cpu_supports("avx512f")) available.push_back(&kAvx512);
#endif
  return available;
}

void SubtractProducts(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y) {
  Chosen().column(l, l_stride, nullptr, w, w_stride, count, n, y);
}

void SubtractColumns(const double* l, int l_stride, const int* places, const double* w, int count, int n, double* y) {
  Chosen().column(l, l_stride, places, w, 1, count, n, y);
}

void SubtractProductMatrix(const double* l, int l_stride, const double* w, int w_stride, int count, int n, int columns,
                           double* y, int y_stride) {
  Chosen().matrix(l, l_stride, w, w_stride, count, n, columns, y, y_stride, 0);
}

void SubtractProductTriangle(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y,
                             int y_stride) {
  Chosen().matrix(l, l_stride, w, w_stride, count, n, n, y, y_stride, 1);
}

void SubtractTransposedProduct(const double* l, int l_stride, int count, int n, const double* x, double* y) {
  Chosen().transposed(l, l_stride, count, n, x, y);
}

double LargestMagnitude(const double* x, int n) { return Chosen().largest(x, n); }

void ScaleAndKeep(double factor, int n, double* x, double* kept) { Chosen().scale(factor, n, x, kept); }

}  // namespace rollgait
