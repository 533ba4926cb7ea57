#ifndef ROLLGAIT_CORE_MATH_SUBTRACT_PRODUCTS_H_
#define ROLLGAIT_CORE_MATH_SUBTRACT_PRODUCTS_H_

#include <vector>

namespace rollgait {

// The inner loops of dense elimination. Matrices are column-major; `stride` is the distance between columns. All run
// with the widest vectors that the processor has. The compiler fuses multiplications and additions where it finds that
// faster, so the last bits of a result depend on the kind of processor.

// y (n) −= Σ_k l_k w_k for `count` columns l_k and numbers w_k (`w_stride` apart). Columns whose number is zero are
// passed over.
void SubtractProducts(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y);
// The inner loop of sparse elimination: the same with columns places[k] of l, numbers next to each other. y is none of
// them.
void SubtractColumns(const double* l, int l_stride, const int* places, const double* w, int count, int n, double* y);

// Y (n × columns) −= L (n × count) W (columns × count)ᵀ.
void SubtractProductMatrix(const double* l, int l_stride, const double* w, int w_stride, int count, int n, int columns,
                           double* y, int y_stride);
// The lower triangle of the same with n = columns; the upper one is left undefined.
void SubtractProductTriangle(const double* l, int l_stride, const double* w, int w_stride, int count, int n, double* y,
                             int y_stride);

// y (count) −= Lᵀ x for L (n × count), x (n).
void SubtractTransposedProduct(const double* l, int l_stride, int count, int n, const double* x, double* y);

// Largest |x_i| of n numbers, 0 of none. NaNs count as 0.
double LargestMagnitude(const double* x, int n);

// kept (n) = x, x *= factor. The two do not overlap.
void ScaleAndKeep(double factor, int n, double* x, double* kept);

// The same for one instruction set; the functions above call the last of those available.
struct ProductKernels {
  const char* name;
  // y −= Σ_k l_k w_k; with places as in SubtractColumns, or null for the columns in order.
  void (*column)(const double* l, int l_stride, const int* places, const double* w, int w_stride, int count, int n,
                 double* y);
  // Y −= L Wᵀ, of column j the rows from j · first_step on.
  void (*matrix)(const double* l, int l_stride, const double* w, int w_stride, int count, int n, int columns, double* y,
                 int y_stride, int first_step);
  void (*transposed)(const double* l, int l_stride, int count, int n, const double* x, double* y);
  double (*largest)(const double* x, int n);
  void (*scale)(double factor, int n, double* x, double* kept);
};
std::vector<const ProductKernels*> AvailableProductKernels();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_SUBTRACT_PRODUCTS_H_
