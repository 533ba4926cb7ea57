#ifndef ROLLGAIT_CORE_NLP_BARRIER_PROBLEM_H_
#define ROLLGAIT_CORE_NLP_BARRIER_PROBLEM_H_

#include <vector>

#include "core/nlp/problem.h"

namespace rollgait {

// A nonlinear program with a slack for every row that has bounds and is not an equality,
//   minimise f(x)  subject to  c(w) = 0,  l ≤ w ≤ u,   w = (x, s),   c_i = g_i − target_i  or  g_i − s_i  or, without
//   bounds, 0,
// and its barrier function  φ_μ(w) = f − μ Σ ln(w − l) − μ Σ ln(u − w) + κ_d μ Σ (distance to a bound without an
// opposite one). Bounds are moved outwards by `relaxation` (NlpOptions::BoundRelaxation). The problem must outlive this
// object.
class BarrierProblem {
 public:
  BarrierProblem(NlpProblem& problem, double relaxation);

  struct Point {
    VectorX w;  // unknowns()
    double f = 0;
    VectorX c;         // rows()
    double theta = 0;  // Σ |c|
  };

  int variables() const { return n_; }
  int rows() const { return m_; }
  int unknowns() const { return static_cast<int>(lower_.size()); }
  bool has_lower(int i) const { return lower_(i) > -kInfinity; }
  bool has_upper(int i) const { return upper_(i) < kInfinity; }
  bool fixed(int i) const { return i < n_ && fixed_[i] != 0; }
  const std::vector<char>& fixed() const { return fixed_; }
  double lower(int i) const { return lower_(i); }
  double upper(int i) const { return upper_(i); }
  // Row of slack k, k = 0 … unknowns() − variables() − 1.
  const std::vector<int>& slack_rows() const { return slack_rows_; }
  // Rows without bounds. They hold nothing, and their multipliers are 0.
  const std::vector<int>& free_rows() const { return free_rows_; }

  // w with x moved inside its bounds by at least `push` (relative to the larger of NlpProblem::variable_size and the
  // bound, and to the distance of the two bounds), slacks likewise from g(x). False if the functions have no finite
  // value there.
  bool MakeInterior(const VectorX& x, double push, Point* point);
  // Fills f, c, θ from w. False if a value is not finite.
  bool Evaluate(Point* point);
  double Barrier(const Point& point, double mu) const { return Barrier(point.f, point.w, mu); }
  // φ_μ of another objective, whose value at w is f.
  double Barrier(double f, const VectorX& w, double mu) const;
  // gradient = base (unknowns()) + ∇(φ_μ − f); 0 for fixed variables.
  void AddBarrierGradient(const Point& point, double mu, const VectorX& base, VectorX* gradient) const;
  // Moves a bound away from w where the distance has been lost to rounding.
  void KeepDistance(const VectorX& w, double mu);
  // The bounds that KeepDistance has moved, as they are now; ±infinity: none.
  struct MovedBound {
    int unknown = 0;
    double lower = 0, upper = 0;
  };
  std::vector<MovedBound> MovedBounds() const;
  // Moves them there again. False, and nothing is moved, if one of them is no bound of this problem moved outwards.
  bool MoveBounds(const std::vector<MovedBound>& bounds);
  bool Gradient(const Point& point, VectorX* gradient);
  NlpProblem& problem() { return problem_; }

 private:
  double Inside(double value, int i, double push) const;
  double Damping(int i, double mu) const;

  NlpProblem& problem_;
  int n_, m_;
  VectorX lower_, upper_, target_;
  std::vector<char> fixed_;
  std::vector<int> slack_rows_, free_rows_;
  std::vector<char> moved_;  // unknowns(): KeepDistance has moved a bound
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_BARRIER_PROBLEM_H_
