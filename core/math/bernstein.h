#ifndef ROLLGAIT_CORE_MATH_BERNSTEIN_H_
#define ROLLGAIT_CORE_MATH_BERNSTEIN_H_

#include "core/base/types.h"

namespace rollgait {

// Bernstein coefficients on [0, 1]: p(θ) = Σ b_k C(d, k) θ^k (1 − θ)^(d − k). The values of p lie between the least and
// the largest coefficient, b_0 = p(0) and b_d = p(1).  Source: Farouki, The Bernstein polynomial basis (2012),
// section 3.

// (d + 1) × (d + 1): b = M m of the monomial coefficients m of degree d (p = Σ m_k θ^k). Contract: 0 <= degree <= 20.
MatrixX BernsteinFromMonomials(int degree);

// s × s: b = M p(c) of the values at s distinct fractions c; degree s − 1.
MatrixX BernsteinFromValues(const VectorX& c);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_BERNSTEIN_H_
