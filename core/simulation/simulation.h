#ifndef ROLLGAIT_CORE_SIMULATION_SIMULATION_H_
#define ROLLGAIT_CORE_SIMULATION_SIMULATION_H_

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/stop.h"
#include "core/simulation/scene.h"

namespace rollgait {

// One contact at an instant. World axes.
struct ContactSample {
  bool active = false, sliding = false;
  double gap = 0;                   // m
  Vector3 point = Vector3::Zero();  // m, on body 1
  Vector3 normal = Vector3::Zero();
  Vector3 slip = Vector3::Zero();   // m/s
  Vector3 force = Vector3::Zero();  // N on body 1; zero if not active
  double spin_torque = 0;           // N m on body 1 about the normal
  double friction_ratio = 0;        // |tangential force| / normal force; infinite without a normal force
};

struct SimulationSample {
  double time = 0;  // s
  VectorX q, v, acceleration;
  std::vector<ContactSample> contacts;  // one per contact of the scene
  double kinetic_energy = 0;            // J
  double potential_energy = 0;          // J, gravity and springs
  double work = 0;                      // J, done so far by everything else, and what impacts took (negative)
};

enum class SimulationEventKind {
  kTouchDown,     // a gap closed: plastic impact
  kLiftOff,       // a normal force fell to zero: the contact became inactive
  kFrictionLoss,  // the friction that rolling needs passed the coefficient; FrictionLoss::kSlide: the contact slides
                  // now
  kFrictionRegained,
  kStick,  // a sliding contact came to rest in its tangent directions and rolls again
};

struct SimulationEvent {
  SimulationEventKind kind = SimulationEventKind::kTouchDown;
  double time = 0;  // s
  int contact = 0;
  VectorX q, velocity_before, velocity_after;
  // Of an impact: per contact of the scene, N s on body 1 (world); contacts that were released and their gap rates,
  // m/s.
  std::vector<Vector3> impulses;
  std::vector<int> released;
  std::vector<double> released_gap_rates;
  double energy_loss = 0;  // J
  bool redundant = false;
  bool consistent = true;  // no held contact pulls, no released one closes
};

enum class SimulationEnd {
  kDuration,      // reached the end
  kImpactCount,   // stop_after_impacts
  kFrictionLoss,  // a contact with FrictionLoss::kStop
  kStopped,       // the stop flag, or the observer said no
  kStepTooSmall,  // the tolerance cannot be met
  kNotFinite,     // the accelerations are not finite; a flat surface in contact is one reason
  kTooManySteps,
  kTooManyEvents,
  kFrictionUndetermined,  // Coulomb friction on rigid bodies leaves the motion undetermined: jamming, or several
                          // contacts whose friction forces are not unique (ConstrainedSolver::SolveSliding)
  kRollingImpossible,  // a unilateral contact would have to pull to go on rolling, and closes if it is let go: friction
                       // without limit has no continuation there
};

// How well the simulation kept what it should, over all steps and samples.
struct SimulationReport {
  SimulationEnd end = SimulationEnd::kDuration;
  double end_time = 0;
  int steps = 0, rejected_steps = 0, evaluations = 0;
  int impacts = 0;
  double energy_initial = 0;  // J, kinetic + potential
  double energy_final = 0;
  double max_energy_error = 0;          // J, |energy − work − energy_initial|
  double max_gap = 0;                   // m, |gap| of active contacts, before projection
  double max_slip = 0;                  // m/s, speed that active contacts forbid, before projection
  double max_quaternion_error = 0;      // | |q| − 1 | before normalisation
  double min_normal_force = kInfinity;  // N, active contacts; infinite if there was none
  double min_normal_force_time = 0;
  int min_normal_force_contact = -1;
  double max_friction_ratio = 0;
  double max_friction_ratio_time = 0;
  int max_friction_ratio_contact = -1;
  bool redundant = false;  // at some instant forces were not unique (ConstrainedSolution::ForcesUnique)
  std::vector<int> active_at_end;
  VectorX q, v;  // at the end
};

// Receives samples (t = 0, every output_step, the end) and events in order of time. False ends the simulation.
struct SimulationObserver {
  std::function<bool(const SimulationSample&)> sample;
  std::function<bool(const SimulationEvent&)> event;
};

// Simulates a scene that CheckScene found nothing wrong with. Violations: the state at t = 0 contradicts the contacts.
// Adaptive integration by DOP853; samples are single steps of it from the last mesh point, or its continuous extension
// where that agrees with them, so they are as accurate as the mesh; events are bracketed on the continuous extension
// and then located with single steps, to rounding. Deterministic.
Result<SimulationReport> Simulate(const SimulationScene& scene, const SimulationObserver& observer,
                                  const StopFlag* stop = nullptr);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_SIMULATION_H_
