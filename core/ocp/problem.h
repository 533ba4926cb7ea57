#ifndef ROLLGAIT_CORE_OCP_PROBLEM_H_
#define ROLLGAIT_CORE_OCP_PROBLEM_H_

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/contact/body_surface.h"
#include "core/ocp/added_constraints.h"
#include "core/ocp/cost_description.h"
#include "core/ocp/point_kind.h"

namespace rollgait {

struct Interval {
  double min = -kInfinity;
  double max = kInfinity;
};

// One phase: the contacts that roll without slipping in it, and bounds on its free duration. Within every interval of
// the mesh efforts are polynomials through their values at the s points of the scheme; `effort_degree`, if set, is the
// most that their degree may be (at least 0; s − 1 and more hold nothing). Where the optimal efforts are singular, or
// jump at the ends of phases, values that are free at every point follow the discretisation's errors: objectives come
// out too low by a share of first order in the intervals' length.
struct PhaseDescription {
  std::vector<int> active;
  Interval duration;  // s
  std::optional<int> effort_degree = std::nullopt;
  // Bounds that the efforts of the actuated joints have in this phase besides those of the joints, one for each or
  // none, N m (N of a prismatic joint); equal ones prescribe an effort. Contract: they leave every effort a value.
  std::vector<Interval> efforts = {};
};

// Bounds on the state (q, v) at one end of a motion that is not periodic, 2n values each; equal ones prescribe it.
struct EndBounds {
  VectorX lower, upper;
};
struct Ends {
  EndBounds start, end;
};

// What the sum of the cost integrals is divided by.
enum class CostDenominator { kDistance, kTime, kNothing };

// The multi-phase problem of section 4.1 of the paper: eqs (4.1)–(4.3) with what they leave open made explicit.
// Periodic, or between given ends (its first case study). World axes: x along the ground, z its normal; all contacts
// are with the plane z = 0.
struct OptimalControlProblem {
  explicit OptimalControlProblem(Model tree) : model(std::move(tree)) {}

  Model model;
  std::vector<ContactSurface> contacts;
  Vector3 gravity{0, 0, -9.81};
  std::vector<PhaseDescription> phases;
  // The end is the left/right mirror image of the start (half cycle), or the start itself (full cycle), moved along x.
  bool mirrored = true;
  int forward_joint = 0;   // prismatic joint along x that carries the displacement
  int lateral_joint = -1;  // prismatic joint along y, if there is one: where it starts is no part of a full cycle
  // If set, the motion goes from one to the other and nothing is periodic. What rolling or touching determines (height
  // and velocity of a body in contact) must be left free here, and `displacement` is prescribed if they prescribe the
  // forward joint's.
  std::optional<Ends> ends;

  // If set, it makes the n rows of motion at one instant of a phase, g(q, v, a, τ) = 0, in place of those of the tree:
  // of a system that is not one of rigid bodies. The model's joints are then coordinates, with their names, limits and
  // efforts; a state x that has a first derivative only is a velocity, whose position is ∫ x dt. What the rows must say
  // is in point_function.h; second derivatives by accelerations are with positions only. Contract: no contacts.
  std::function<std::unique_ptr<PointConstraint>(const PointLayout&)> equations_of_motion;

  std::vector<CostDescription> costs;
  CostDenominator denominator = CostDenominator::kDistance;

  double friction_coefficient = 0.8;
  double min_normal_force = 0;    // N
  double swing_clearance = 0.01;  // m
  // Bodies with a thickness, the pairs of them that can meet, and the least distance at collocation points of those
  // that are kept apart (AddedConstraints), m: what they may approach each other between the points.
  std::vector<BodySurface> bodies;
  std::vector<BodyPair> pairs;
  static constexpr double kPairClearance = 1e-3;
  double pair_clearance = kPairClearance;
  std::optional<Interval> touch_down_point, lift_off_point;
  // New contacts may arrive with a velocity that a plastic impact without slip takes away, at once and in every contact
  // of the new phase. Else they arrive at rest.
  bool plastic_touch_down = false;

  Interval displacement;  // m over all phases
  Interval duration;      // s over all phases
  Interval speed;         // m/s; equal bounds prescribe it
  // Share of the cycle that a foot stands, mean of both feet; equal bounds prescribe it.
  std::optional<Interval> duty_factor;

  double force_size() const { return model.total_mass() * gravity.norm(); }
  double lever = 0.15;  // m
  // N s: a tenth of a second of the weight.
  double impulse_size() const { return 0.1 * force_size(); }
  double effort_size() const { return lever * force_size(); }  // N m: about 100 for an adult

  // The contacts of the phase before `phase` as that phase sees them: for the first one, those of the last, mirrored;
  // none where there are ends.
  std::vector<int> PreviousActive(int phase) const;
  // Whether velocities jump at the start of a phase: touch-down is plastic, and something touches down there.
  bool Jumps(int phase) const;
  // Contacts that are taken up at the start of a phase, or given up at its end.
  std::vector<int> TakenUp(int phase) const;
  std::vector<int> GivenUp(int phase) const;
  // Whether the forces of contacts that are taken up at the start of a phase, or given up at its end, vanish there:
  // where all efforts are continuous, since their rates cost something, velocities do not jump, and no least normal
  // force is asked for. Source: docs/explanation/contact_changes.md.
  bool ForcesVanishAtStart(int phase) const;
  bool ForcesVanishAtEnd(int phase) const;
  // How many feet stand in a phase. Contacts that mirror each other are of different feet; one that mirrors itself is a
  // foot.
  int StandingFeet(int phase) const;
  // The contacts of the problem with the directions in which they are held in a phase: of active contacts on one link
  // the first is held in all of its directions, the others not along x. Two points of one rigid body cannot both be
  // held along the line that joins them: the rows would depend on each other. Forces act in all directions; how
  // contacts of one link share the force along x is the matter of ForceSharesConstraint.
  std::vector<ContactSurface> PhaseContacts(int phase) const;
  std::vector<ActiveContact> ActiveContacts(int phase) const;
  PointLayout Layout(int phase) const;
  // What the effort of an actuated joint (its place in Model::actuated) may be in a phase, N m (N).
  Interval EffortBounds(int phase, int effort) const;

  // Rows at every point of the scheme. The last ones keep the pairs `separated` apart.
  std::vector<std::unique_ptr<PointConstraint>> PointConstraints(int phase, PointKind kind,
                                                                 const std::vector<int>& separated = {}) const;
  // Rows at the first node of a phase: new contacts touch and are at rest, after a jump all contacts are; prescribed
  // contact points.
  std::vector<std::unique_ptr<PointConstraint>> EntryConstraints(int phase) const;
  // The instant of a jump, z = (q, 0, v⁺ − v⁻, Λ): no efforts, and impulses in place of forces.
  PointLayout JumpLayout(int phase) const;
  // Rows of a jump on that z, with a tree at rest and without gravity:  M(q) (v⁺ − v⁻) = Σ Jᵀ Λ, and impulses in the
  // friction cone, contacts that are taken up coming from above. That the contacts are at rest afterwards is among
  // EntryConstraints. What contacts of one link bear along the line that joins them is left open: impulses may be zero,
  // and where they all are, the gradient of ForceSharesConstraint is zero as well and its multiplier without limit.
  // Source: contact-math 7.
  std::vector<std::unique_ptr<PointConstraint>> JumpConstraints(int phase) const;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_PROBLEM_H_
