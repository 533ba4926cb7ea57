#ifndef ROLLGAIT_CORE_VALIDATION_FORCE_JUDGE_H_
#define ROLLGAIT_CORE_VALIDATION_FORCE_JUDGE_H_

#include <vector>

#include "core/math/chebyshev.h"
#include "core/models/scene.h"
#include "core/validation/findings.h"

namespace rollgait {

// Extremes of contact forces or impulses. The friction ratio is |tangential| / max(normal, 0.001 × weight): below that
// floor a normal force says nothing about friction, and a pulling contact with a tangential force shows as a large
// ratio.
class ForceExtremes {
 public:
  // `weight` in N (of impulses: N s), > 0.
  explicit ForceExtremes(double weight) : weight_(weight) {}
  // A force of the ground on the body, N, world axes. A NaN counts as −∞ and as an infinite ratio.
  void Add(const Vector3& force);
  void AddNormal(double normal);
  void AddRatio(double ratio) { RaiseTo(ratio, &max_friction_ratio_); }

  double weight() const { return weight_; }
  double floor() const;  // of normal forces
  // N; 0 if no force was added.
  double min_normal() const { return any_ ? min_normal_ : 0; }
  double max_friction_ratio() const { return max_friction_ratio_; }

 private:
  double weight_;
  double min_normal_ = kInfinity;
  double max_friction_ratio_ = 0;
  bool any_ = false;
};

// What forces are judged against.
struct ForceBounds {
  double friction = kInfinity;  // coefficient of the ground
  double min_normal = 0;        // N
};

// Judges the forces of the contacts of one phase together. Where two or more contacts belong to one rigid link, its
// motion does not determine the forces along the lines between them, so friction is judged by whether some distribution
// with the same net wrench is admissible: tangential forces are shifted along those lines such that the largest ratio
// of the link is as small as it can be. Two contacts: exact. More: pair after pair, which bounds the least ratio from
// above, so that friction is never judged too small. Contact points of one link differ in height by their gaps only,
// and the shift leaves normal forces as they are.
class ForceJudge {
 public:
  // `contacts` are indices into the scene's. `extremes` has the weight and takes every figure.
  ForceJudge(const Scene& scene, const std::vector<int>& contacts, const ForceBounds& bounds, ForceExtremes* extremes);

  int contacts() const { return static_cast<int>(contacts_.size()); }

  // Rows that a contact has in a matrix of functions of time: force x y z, point x y.
  static constexpr int kRows = 5;
  // Largest ratio of friction at one instant, and the contact (of this phase) that has it. `rows` as above, one contact
  // after the other. Infinite if a number is NaN. No allocation.
  double FrictionRatio(const double* rows, int* worst) const;

  // Judges over a piece of time: `coefficients` (ChebyshevBasis, of rows from first_row on) over θ ∈ [0, 1], which is
  // start … start + length in time, `samples` the same on the basis's grid; `at` gives phase and interval.
  void JudgeFriction(const ChebyshevBasis& basis, const MatrixX& coefficients, const MatrixX& samples, int first_row,
                     double start, double length, Instant at, FindingLog* log) const;
  void JudgeNormal(const ChebyshevBasis& basis, const MatrixX& coefficients, const MatrixX& samples, int first_row,
                   double start, double length, Instant at, FindingLog* log) const;

  // One normal force, or the ratio of one instant, of contact c of this phase.
  void AddNormal(int c, double normal, const Instant& at, FindingLog* log) const;
  void AddRatio(int c, double ratio, const Instant& at, FindingLog* log) const;
  // A name other than the contact's, for impulses: "touch-down left_heel".
  void SetPrefix(const std::string& prefix);

 private:
  struct Member {
    std::string name;
    int link;
    bool along_x, along_y;
  };
  static constexpr int kMostContacts = 16;
  static constexpr int kMostSamples = 64;

  // Shifts tangential forces between contacts of one link; t has two numbers a contact.
  void Share(const double* rows, double* tangents) const;

  std::vector<Member> contacts_;
  std::vector<std::pair<int, int>> pairs_;  // of contacts of one link
  bool shared_once_ = true;                 // no link has more than two contacts
  ForceBounds bounds_;
  ForceExtremes* extremes_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_FORCE_JUDGE_H_
