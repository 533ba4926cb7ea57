#ifndef ROLLGAIT_CORE_SIMULATION_SCENE_H_
#define ROLLGAIT_CORE_SIMULATION_SCENE_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/contact/constrained_dynamics.h"
#include "core/contact/tree_contact.h"
#include "core/multibody/model.h"
#include "core/simulation/ground_motion.h"

namespace rollgait {

// A touch-down counts only while the position of a joint is within [min, max].
struct Gate {
  int joint = 0;
  double min = -kInfinity, max = kInfinity;  // rad or m
};

// What happens when the ratio |tangential force| / normal force that rolling needs exceeds the coefficient of friction.
enum class FrictionLoss {
  kReport,  // the contact goes on rolling; the event is reported
  kStop,    // the simulation ends there
  kSlide,   // the contact slides with Coulomb friction until it sticks again; it may slip at the start, too
};

struct SceneContact {
  TreeContact contact;
  bool active = false;          // at the start
  bool bilateral = false;       // may pull; never lifts off
  bool can_touch_down = true;   // an inactive contact whose gap closes becomes active by a plastic impact
  double friction = kInfinity;  // coefficient; infinite: not checked
  FrictionLoss friction_loss = FrictionLoss::kReport;
  std::vector<Gate> gates;  // all must be open for a touch-down to count
  int mirror = -1;          // index of the contact that takes this one's part in the mirror image; -1: itself
};

enum class DriftControl {
  kNone,        // accelerations only: gap and slip keep what integration errors give them
  kBaumgarte,   // accelerations are corrected by the terms of `baumgarte`
  kProjection,  // after every step onto gap = 0, then onto no slip, by the change of least kinetic energy
};

struct SimulationOptions {
  double duration = 1;      // s, (0, 1e7]
  double tolerance = 1e-9;  // of the integrator, relative, [1e-14, 1e-2]
  // Of the integrator, in the units of positions and velocities, [1e-30, 1e-2]. Without it as `tolerance`.
  std::optional<double> absolute_tolerance;
  double output_step = 0.01;  // s between samples, (0, duration]
  DriftControl drift = DriftControl::kProjection;
  Baumgarte baumgarte;
  int max_steps = 1'000'000;   // of the integrator, rejected ones included, [1, 1e9]
  int max_events = 10'000;     // [1, 1e6]
  int stop_after_impacts = 0;  // 0: no limit
};

// A mechanism, its ground, its state at t = 0 and how to simulate it. A value; valid if it comes out of CheckScene.
struct SimulationScene {
  std::string name;
  Model model;                       // with the springs and dampers of its joints
  std::vector<double> efforts;       // N m or N, constant, one per joint; without meaning for a free joint
  std::vector<GroundMotion> ground;  // frames that contacts refer to; frame 0 is the fixed world
  std::vector<SceneContact> contacts;
  Vector3 gravity{0, 0, -9.81};  // m/s², world
  VectorX q, v;                  // (nq), (nv) at t = 0
  // Joints whose positions and velocities are computed from the others so that the active contacts touch and do not
  // slip: positions by least change (sliding and free joints translate, turning joints turn), velocities replaced. Of a
  // free joint the translation only.
  std::vector<int> adjusted_joints;
  // Joint along which a walker travels: its position is not part of a periodic gait. -1: none.
  int travel_joint = -1;
  SimulationOptions options;
};

// Limits of a scene; beyond them it is refused.
inline constexpr int kMaxSceneJoints = 64;
inline constexpr int kMaxSceneContacts = 16;
inline constexpr int kMaxSceneGrounds = 16;
inline constexpr double kMaxSamples = 2e6;
inline constexpr double kMaxSceneNumber = 1e9;  // magnitude of any position, velocity, force or rate

// Everything that is wrong with the numbers of the scene, by the path of the field in rollgait.v1.SimulationScene;
// empty if it can be simulated. The model is checked already (Model::Create).
Violations CheckScene(const SimulationScene& scene);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_SCENE_H_
