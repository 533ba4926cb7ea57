#ifndef ROLLGAIT_CORE_VALIDATION_GAIT_EVENTS_H_
#define ROLLGAIT_CORE_VALIDATION_GAIT_EVENTS_H_

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/gait_cycle.h"

namespace rollgait {

// Curves of GaitEvents are given at this many equal steps of the cycle, 0 and 100 % included.
inline constexpr int kCycleSteps = 200;

enum class Foot { kRight = 0, kLeft = 1 };
inline constexpr int kFootCount = 2;

// Of a foot with two surfaces or more, "rear" and "front" are those whose lowest points lie furthest back and furthest
// forward in the upright posture (all joints at zero). A foot with one surface has no foot flat and no heel off.
enum class GaitEventKind {
  kHeelStrike,  // initial contact: the foot, on the ground with no surface before, is on it with one or more
  kFootFlat,    // the first instant of a stance with rear and front surface on the ground
  kHeelOff,     // the rear surface leaves the ground for the last time in a stance, the foot stays
  kToeOff,      // the last surface of the foot leaves the ground
};

struct GaitEvent {
  GaitEventKind kind;
  Foot foot;
  double percent;  // of the cycle, [0, 100)
};

// One foot: the contacts of the links beyond one leg's joints, however many they are. The curves have one column an
// instant (kCycleSteps + 1; at 100 % the limit from the left, at an event the limit from the right).
struct FootOnGround {
  std::vector<int> contacts;  // indices into Scene::contacts, ascending
  double stance = 0;          // share of the cycle with a contact on the ground, 0 … 1; the rest is swing
  // The step that ends with the heel strike of this foot, from that of the other: m along x between the places where
  // the two come down (of several surfaces at once the rearmost), and s. Zero without a heel strike of both feet, and
  // where both come down at the same instant.
  double step_length = 0, step_duration = 0;
  // Share of the cycle on both feet that begins with the heel strike of this foot; zero without one.
  double loading = 0;
  MatrixX force;  // 3 × instants, N, of the ground on the foot: sum over its contacts, world axes (fixed to the ground)
  MatrixX level_force;  // the same force in axes that gravity gives: forward horizontal, left, up
  // 2 × instants, m, centre of pressure on the ground plane, world axes x and y; the body goes on through the cycle.
  // NaN where the normal force on the foot is below kLeastLoad of body weight.
  MatrixX center_of_pressure;
};
inline constexpr double kLeastLoad = 0.01;

// What a gait laboratory's force plates and event detection say of the full cycle, from heel strike to heel strike of
// one foot, the right one unless said otherwise.
struct GaitEvents {
  double start = 0;         // s, GaitCycle::start
  double duration = 0;      // s
  double displacement = 0;  // m
  double body_weight = 0;   // N
  std::vector<GaitEvent>
      events;  // ascending by percent; at the same percent right before left, then in the order of the kinds
  std::vector<GaitCycle::Span> spans;
  std::array<FootOnGround, kFootCount> feet;
  double double_support = 0, single_support = 0, flight = 0;  // shares of the cycle, their sum is 1

  // Right less left over their mean; 0 where that mean is 0. Of step length, step duration and stance. Durations and
  // stances are not negative, which keeps theirs in [-2, 2]; a step length may be negative (a foot that comes down
  // behind the other), and then that of lengths may be any number.
  double StepLengthAsymmetry() const;
  double StepDurationAsymmetry() const;
  double StanceAsymmetry() const;

  const FootOnGround& foot(Foot which) const { return feet[static_cast<int>(which)]; }
  // % of the first such event; empty if there is none.
  std::optional<double> First(GaitEventKind kind, Foot foot) const;
};

// `gravity` in world axes, not zero; the cycle begins with the heel strike of `first`. Empty without a gait cycle, see
// GaitCycle::Of, whose contract holds.
std::optional<GaitEvents> MeasureGaitEvents(const Scene& scene, const Trajectory& trajectory, const Vector3& gravity,
                                            Foot first = Foot::kRight);

BodySide SideOf(Foot foot);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_GAIT_EVENTS_H_
