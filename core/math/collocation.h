#ifndef ROLLGAIT_CORE_MATH_COLLOCATION_H_
#define ROLLGAIT_CORE_MATH_COLLOCATION_H_

#include <vector>

#include "core/base/types.h"

namespace rollgait {

// A Runge–Kutta scheme with s points (stages) for  q̈ = a  on one interval of length h:
//   v_i = v₀ + h Σ A_ij a_j,  q_i = q₀ + h c_i v₀ + h² Σ (A²)_ij a_j,  v_e = v₀ + h Σ b_j a_j,  q_e likewise with bᵀA.
struct Tableau {
  MatrixX A;                 // s × s
  VectorX b;                 // s, positive
  VectorX c;                 // s, ascending, last 1
  int order;                 // classical order of the scheme
  int effort_degree;         // most that the degree of efforts in an interval may be
  bool is_explicit = false;  // A is zero but below its diagonal: the state of a stage follows from the stages before it
  int points() const { return static_cast<int>(c.size()); }
  // Efforts of an explicit method that change within intervals do not jump between those of a phase: with jumps at
  // every node the optimiser follows the errors of the steps.
  bool joins_efforts() const { return is_explicit && effort_degree > 0; }
  // The first point is the node itself (Lobatto): its state is not new, only its acceleration is.
  bool starts_at_node() const { return c(0) == 0; }
};

// The tableau with points c (distinct, ascending): A, b by integrating the Lagrange polynomials through them.
Tableau CollocationTableau(const VectorX& c, int order);
// An explicit scheme with points c; `stages`: what A has below its diagonal, row by row. b interpolates: the quadrature
// through c.
Tableau ExplicitTableau(const VectorX& c, const std::vector<double>& stages, int order, int effort_degree);

// Values of the Lagrange polynomials through the points c at θ, and of their first and second integrals from 0.
VectorX LagrangeValues(const VectorX& c, double theta);
VectorX LagrangeIntegrals(const VectorX& c, double theta);
VectorX LagrangeSecondIntegrals(const VectorX& c, double theta);

// A scheme with what is linear eliminated. The interval's unknowns per coordinate are the node states q₀, v₀,
// q_e, v_e and the accelerations of the first s − 2 points ("sources", in this order); position, velocity and
// acceleration of every point are linear in them for a given h:
//   z_i = Σ_src  value(i, src) · h^power(src) · source,   exact by construction: no collocation or continuity rows
//   remain.
class EliminatedScheme {
 public:
  explicit EliminatedScheme(const Tableau& tableau);

  enum Kind { kPosition = 0, kVelocity = 1, kAcceleration = 2 };
  static constexpr Kind kKinds[] = {kPosition, kVelocity, kAcceleration};
  int points() const { return points_; }
  int sources() const { return sources_; }
  const Tableau& tableau() const { return tableau_; }

  // Coefficient of a source in a quantity of point i for step h, and its first and second derivative by h.
  double Value(Kind kind, int i, int source, double h) const;
  double First(Kind kind, int i, int source, double h) const;
  double Second(Kind kind, int i, int source, double h) const;
  // False if the coefficient is zero for every h.
  bool Depends(Kind kind, int i, int source) const { return coefficient_[kind](i, source) != 0; }

 private:
  int Power(Kind kind, int source) const;
  Tableau tableau_;
  int points_, sources_;
  MatrixX coefficient_[3];  // points × sources
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_COLLOCATION_H_
