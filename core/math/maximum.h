#ifndef ROLLGAIT_CORE_MATH_MAXIMUM_H_
#define ROLLGAIT_CORE_MATH_MAXIMUM_H_

#include <cmath>
#include <span>

namespace rollgait {

struct Maximum {
  double value, at;
};

// The largest value of f in [left, right] that golden-section search finds, starting from the samples f(left), f(right)
// and any f(middle) between; the maximum, to the relative rounding of a smooth f, if f has one maximum there.
template <class Function>
Maximum MaximumIn(const Function& f, double left, double right, Maximum best) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kResolution = 1e-6;  // of the bracket: a smooth f changes by the square of it, 1e-12 of its range
  const double stop = kResolution * (right - left);
  double x1 = right - kGolden * (right - left), x2 = left + kGolden * (right - left);
  double f1 = f(x1), f2 = f(x2);
  while (right - left > stop) {
    if (f1 >= f2) {
      right = x2, x2 = x1, f2 = f1;
      x1 = right - kGolden * (right - left), f1 = f(x1);
    } else {
      left = x1, x1 = x2, f1 = f2;
      x2 = left + kGolden * (right - left), f2 = f(x2);
    }
    if (f1 > best.value) best = {f1, x1};
    if (f2 > best.value) best = {f2, x2};
  }
  return best;
}

// The maximum of f over grid.front() … grid.back() (ascending), given its samples there: every local maximum of the
// samples that could be the largest is searched between its neighbours. It finds the maximum if f has at most one
// maximum between two neighbours of the grid, and no maximum rises above its highest sample by more than a quarter of
// the range of the samples. Contract: at least two samples, all finite.
template <class Function>
Maximum MaximumOverGrid(const Function& f, std::span<const double> grid, std::span<const double> samples) {
  const int n = static_cast<int>(samples.size());
  Maximum best{samples[0], grid[0]};
  double least = samples[0];
  for (int i = 1; i < n; ++i) {
    if (samples[i] > best.value) best = {samples[i], grid[i]};
    if (samples[i] < least) least = samples[i];
  }
  const double margin = 0.25 * (best.value - least);
  if (!(margin > 0)) return best;
  const double enough = best.value - margin;
  for (int i = 0; i < n; ++i) {
    if (samples[i] < enough) continue;
    if ((i > 0 && samples[i - 1] > samples[i]) || (i + 1 < n && samples[i + 1] > samples[i])) continue;
    const double left = grid[i > 0 ? i - 1 : i], right = grid[i + 1 < n ? i + 1 : i];
    const Maximum found = MaximumIn(f, left, right, {samples[i], grid[i]});
    if (found.value > best.value) best = found;
  }
  return best;
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_MAXIMUM_H_
