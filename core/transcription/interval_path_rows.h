#ifndef ROLLGAIT_CORE_TRANSCRIPTION_INTERVAL_PATH_ROWS_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_INTERVAL_PATH_ROWS_H_

#include <string>
#include <vector>

#include "core/math/collocation.h"
#include "core/ocp/constraints/friction.h"
#include "core/ocp/problem.h"

namespace rollgait {

// Where an interval lies in its phase.
struct IntervalPlace {
  bool first = false, last = false;
};

// Rows that bound the polynomials of one interval of a phase at every instant, by their Bernstein coefficients: a
// polynomial lies in the convex hull of its coefficients. Bounded are the normal forces and the friction of all active
// contacts (pyramids with the edges that AddedConstraints names besides the usual ones), and of the joints that it
// names range, velocity and effort. Coefficients that are unknowns themselves have bounds in place of rows, but for
// friction. Further rows hold the degree of the efforts in a phase that has one (PhaseDescription).
//   A row is  lower <= Σ coefficient · h^power · y_local · scale_local <= upper,  with the interval's length h in s.
// At the ends of a phase the forces of contacts that are taken up or given up at rest vanish where the problem says so
// (OptimalControlProblem::ForcesVanish). Source: docs/explanation/contact_changes.md.
class IntervalPathRows {
 public:
  // Local variables as in IntervalBlock: sources of the scheme, then the controls of every point.
  struct Locals {
    std::vector<int> sources;   // first local variable of each source
    std::vector<int> controls;  // first local variable of each point's efforts and forces
  };
  IntervalPathRows(const OptimalControlProblem& problem, const AddedConstraints& added, int phase,
                   const EliminatedScheme& scheme, const Locals& locals, const VectorX& scale);

  int size() const { return static_cast<int>(rows_.size()); }
  // What tells a row from the others of its phase, whatever rows the phase has.
  const std::string& Key(int row) const { return rows_[row].key; }
  const std::string& Name(int row) const { return rows_[row].name; }
  const std::string& Unit(int row) const { return rows_[row].unit; }
  double Size(int row) const { return rows_[row].size; }
  // Whether a row is another one in the first, or the last, interval of the phase, since forces vanish there.
  bool ChangesAtStart(int row) const { return rows_[row].at_start != AtZero::kSame; }
  bool ChangesAtEnd(int row) const { return rows_[row].at_end != AtZero::kSame; }
  // In units of Size.
  void Bounds(const IntervalPlace& place, double* lower, double* upper) const;

  // (row, local variable) in the order in which Jacobian writes; `step` is the local variable of h.
  Entries JacobianPattern(int step) const;
  // Pairs of local variables with a second derivative, h among them.
  Entries HessianPairs(int step) const;
  void Values(const double* y, double h, double* g) const;
  // The force of one contact in space at one Bernstein coefficient, N, world, and what the objective of the NLP would
  // fall by, to first order, for each N along x and y beyond the sides of its pyramid: Σ |λ| n, n the normals of the
  // sides.
  struct HeldForce {
    int contact;
    Vector3 force;
    Eigen::Vector2d pull;
  };
  // `lambda`: the multipliers of these rows, in Ipopt's signs.
  std::vector<HeldForce> HeldForces(const double* y, const double* lambda) const;
  // Returns the end of what it wrote.
  double* Jacobian(const double* y, double h, double* values) const;
  // Adds the Hessian of λᵀ g by unscaled unknowns (scale · y) and h, the last local variable, to the lower triangle of
  // `local`.
  void AddHessian(const double* y, double h, const double* lambda, Eigen::Ref<MatrixX> local) const;

 private:
  struct Term {
    int local;
    double coefficient;  // of the unscaled unknown, divided by the size of the row
    int power;
  };
  // What a row becomes where the forces of its contacts vanish.
  enum class AtZero { kSame, kEquals, kFree };
  struct Row {
    std::string key, name, unit;
    double size = 1, lower = 0, upper = 0;  // bounds in units of size
    std::vector<Term> terms;
    AtZero at_start = AtZero::kSame, at_end = AtZero::kSame;
    bool depends_on_step() const;
  };
  // Friction of one contact in space at one coefficient: the three forces by the unknowns, N, and rows with normals.
  struct Pyramid {
    int contact;
    std::vector<Term> forces[3];
    std::vector<std::pair<int, Eigen::Vector2d>> sides;
  };
  // (offset as in ActiveContact, coefficient)
  using ForceSum = std::vector<std::pair<int, double>>;
  // Bernstein coefficient k of the sum, in units of `unit`; `forces`: first local variable of each point's forces.
  std::vector<Term> ForceTerms(int k, const std::vector<int>& forces, double unit, const ForceSum& sum) const;
  void AddForces(const OptimalControlProblem& problem, int phase, const std::vector<FrictionEdge>& edges,
                 const Locals& locals);
  void AddPyramids(int k, const std::vector<int>& forces, const std::vector<ActiveContact>& active,
                   const std::vector<ForceRow>& friction);
  void AddDegree(const OptimalControlProblem& problem, int degree, const VectorX& c, const Locals& locals);
  void AddEfforts(const OptimalControlProblem& problem, int phase, int effort, const Locals& locals);
  void AddStates(const OptimalControlProblem& problem, int joint, bool velocity, const EliminatedScheme& scheme,
                 const Locals& locals);

  MatrixX from_points_;  // Bernstein coefficients of the polynomial through the values at the points
  const VectorX& scale_;
  std::vector<Row> rows_;
  std::vector<Pyramid> pyramids_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_INTERVAL_PATH_ROWS_H_
