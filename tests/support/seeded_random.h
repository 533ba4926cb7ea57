#ifndef ROLLGAIT_TESTS_SUPPORT_SEEDED_RANDOM_H_
#define ROLLGAIT_TESTS_SUPPORT_SEEDED_RANDOM_H_

#include <cmath>
#include <numbers>
#include <random>

#include "core/base/types.h"

namespace rollgait {

// Random test inputs that are the same on every machine. Not thread-safe.
class SeededRandom {
 public:
  explicit SeededRandom(unsigned seed) : engine_(seed) {}

  // In [min, max). Written out because the standard distributions differ between libraries.
  double Uniform(double min, double max) { return min + (max - min) * (static_cast<double>(engine_()) / 4294967296.0); }
  // Uniform in the logarithm; 0 < min < max.
  double LogUniform(double min, double max) { return std::exp(Uniform(std::log(min), std::log(max))); }
  Vector3 Vector(double min, double max) {
    const double x = Uniform(min, max), y = Uniform(min, max);
    return {x, y, Uniform(min, max)};
  }
  VectorX VectorOf(int size, double min, double max) {
    VectorX vector(size);
    for (int i = 0; i < size; ++i) vector(i) = Uniform(min, max);
    return vector;
  }
  // Uniform on the unit sphere.
  Vector3 Unit() {
    const double z = Uniform(-1, 1), angle = Uniform(0, 2 * std::numbers::pi), radius = std::sqrt(1 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

 private:
  std::mt19937 engine_;  // 32 bits a draw
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_SEEDED_RANDOM_H_
