#include "core/math/subtract_products.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace rollgait {
namespace {

// What is inlined into a function takes that function's instruction set.
#define ROLLGAIT_INLINE inline __attribute__((always_inline))

constexpr int kLanes = 4;
// Without AVX the compiler makes two instructions of one.
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));

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

// A tile of R · kLanes rows and C columns of Y, held in registers while all k go by. W's numbers of the columns are neighbours.
template <int R, int C>
ROLLGAIT_INLINE void Tile(const double* l, int l_stride, const double* w, int w_stride, int count, double* y, int y_stride) {
  Lanes sum[R][C];
  for (int c = 0; c < C; ++c) {
    for (int r = 0; r < R; ++r) std::memcpy(&sum[r][c], y + static_cast<size_t>(c) * y_stride + r * kLanes, sizeof(Lanes));
  }
  for (int k = 0; k < count; ++k, l += l_stride, w += w_stride) {
    Lanes column[R];
    for (int r = 0; r < R; ++r) std::memcpy(&column[r], l + r * kLanes, sizeof(Lanes));
    for (int c = 0; c < C; ++c) {
      for (int r = 0; r < R; ++r) sum[r][c] -= column[r] * w[c];
    }
  }
  for (int c = 0; c < C; ++c) {
    for (int r = 0; r < R; ++r) std::memcpy(y + static_cast<size_t>(c) * y_stride + r * kLanes, &sum[r][c], sizeof(Lanes));
  }
}

template <int C>
ROLLGAIT_INLINE void Rows(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y,
                          int y_stride) {
  int i = 0;
  for (; i + 3 * kLanes <= n; i += 3 * kLanes) Tile<3, C>(l + i, l_stride, w, w_stride, count, y + i, y_stride);
  for (; i + kLanes <= n; i += kLanes) Tile<1, C>(l + i, l_stride, w, w_stride, count, y + i, y_stride);
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

// Of column j the rows from j · first_step on.
ROLLGAIT_INLINE void MatrixKernel(const double* l, int l_stride, const double* w, int w_stride, int count, int n,
                                  int columns, double* y, int y_stride, int first_step) {
  constexpr int kColumns = 4;
  int j = 0;
  for (; j + kColumns <= columns; j += kColumns) {
    const int first = j * first_step;
    Rows<kColumns>(l + first, l_stride, w + j, w_stride, count, n - first, y + static_cast<size_t>(j) * y_stride + first,
                   y_stride);
  }
  for (; j < columns; ++j) {
    const int first = j * first_step;
    Rows<1>(l + first, l_stride, w + j, w_stride, count, n - first, y + static_cast<size_t>(j) * y_stride + first, y_stride);
  }
}

template <int K>
ROLLGAIT_INLINE void Dots(const double* l, int l_stride, int n, const double* x, double* y) {
  Lanes sum[K] = {};
  int i = 0;
  for (; i + kLanes <= n; i += kLanes) {
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
  for (; k + kColumns <= count; k += kColumns) Dots<kColumns>(l + static_cast<size_t>(k) * l_stride, l_stride, n, x, y + k);
  for (; k < count; ++k) Dots<1>(l + static_cast<size_t>(k) * l_stride, l_stride, n, x, y + k);
}

struct Kernels {
  void (*column)(const double*, int, const int*, const double*, int, int, int, double*);
  void (*matrix)(const double*, int, const double*, int, int, int, int, double*, int, int);
  decltype(&SubtractTransposedProduct) transposed;
};

// The three kernels for one instruction set.
#define ROLLGAIT_KERNELS(NAME, TARGET)                                                                                    \
  TARGET void NAME##Column(const double* l, int l_stride, const int* places, const double* w, int w_stride,             \
                           int count, int n, double* y) {                                                               \
    ColumnKernel(l, l_stride, places, w, w_stride, count, n, y);                                                        \
  }                                                                                                                     \
  TARGET void NAME##Matrix(const double* l, int l_stride, const double* w, int w_stride, int count, int n, int columns,   \
                           double* y, int y_stride, int first_step) {                                                     \
    MatrixKernel(l, l_stride, w, w_stride, count, n, columns, y, y_stride, first_step);                                   \
  }                                                                                                                       \
  TARGET void NAME##Transposed(const double* l, int l_stride, int count, int n, const double* x, double* y) {             \
    TransposedKernel(l, l_stride, count, n, x, y);                                                                        \
  }                                                                                                                       \
  constexpr Kernels k##NAME = {NAME##Column, NAME##Matrix, NAME##Transposed};

ROLLGAIT_KERNELS(Portable, )
#if defined(__x86_64__)
ROLLGAIT_KERNELS(Wide, __attribute__((target("avx2,fma"))))
#endif

const Kernels& Chosen() {
#if defined(__x86_64__)
  static const Kernels& kernels =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? kWide : kPortable;
  return kernels;
#else
  return kPortable;
#endif
}

}  // namespace

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

}  // namespace rollgait
