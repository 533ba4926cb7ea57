#ifndef ROLLGAIT_TESTS_SUPPORT_MATRIX_NEAR_H_
#define ROLLGAIT_TESTS_SUPPORT_MATRIX_NEAR_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>

namespace rollgait {

// Unit roundoff times two: the distance from 1 to the next number.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Passes if both have the same shape and no entry differs by more than `tolerance` (absolute) or is NaN. For
// EXPECT_TRUE.
template <typename A, typename B>
::testing::AssertionResult MatrixNear(const Eigen::MatrixBase<A>& actual, const Eigen::MatrixBase<B>& expected,
                                      double tolerance) {
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols()) {
    return ::testing::AssertionFailure() << "shape " << actual.rows() << " x " << actual.cols() << ", expected "
                                         << expected.rows() << " x " << expected.cols();
  }
  for (Eigen::Index j = 0; j < actual.cols(); ++j) {
    for (Eigen::Index i = 0; i < actual.rows(); ++i) {
      const double difference = static_cast<double>(actual(i, j) - expected(i, j));
      if (!(difference <= tolerance && difference >= -tolerance)) {
        return ::testing::AssertionFailure() << "entry (" << i << ", " << j << ") differs by " << difference
                                             << ", allowed " << tolerance << "; actual\n"
                                             << actual << "\nexpected\n"
                                             << expected;
      }
    }
  }
  return ::testing::AssertionSuccess();
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_MATRIX_NEAR_H_
