#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>
#include <string>

#include "core/base/field_path.h"
#include "core/multibody/body_dynamics.h"
#include "core/simulation/scene.h"

namespace rollgait {
namespace {

std::string ElementOf(const char* list, size_t i) { return Indexed(list, i) + "."; }

class SceneChecker {
 public:
  explicit SceneChecker(const SimulationScene& scene) : scene_(scene) {}

  Violations Run() {
    CheckSizes();
    if (!violations_.empty()) return violations_;
    CheckJoints();
    CheckGround();
    CheckContacts();
    CheckOptions();
    if (violations_.empty()) CheckMass();
    return violations_;
  }

 private:
  template <typename Value>
  void Refuse(const std::string& field, const Value& value, const std::string& rule) {
    std::ostringstream message;
    message.precision(15);
    message << "is " << value << "; " << rule;
    violations_.push_back({field, message.str()});
  }

  // Written so that NaN fails.
  void CheckRange(const std::string& field, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return;
    std::ostringstream rule;
    rule << "must be within [" << low << ", " << high << "]" << unit;
    Refuse(field, value, rule.str());
  }

  void CheckVector(const std::string& field, const Vector3& value, const char* unit) {
    if (value.allFinite() && value.cwiseAbs().maxCoeff() <= kMaxSceneNumber) return;
    std::ostringstream rule;
    rule << "every component must be finite and within ±" << kMaxSceneNumber << unit;
    Refuse(field, value.transpose(), rule.str());
  }

  void CheckCount(const char* field, size_t count, int limit) {
    if (count > static_cast<size_t>(limit)) {
      Refuse(field, "a list of " + std::to_string(count), "must have at most " + std::to_string(limit) + " entries");
    }
  }

  void CheckSizes() {
    CheckCount("joints", scene_.model.joints().size(), kMaxSceneJoints);
    CheckCount("contacts", scene_.contacts.size(), kMaxSceneContacts);
    CheckCount("ground", scene_.ground.size(), kMaxSceneGrounds);
  }

  void CheckJoints() {
    for (int i = 0; i < scene_.model.size(); ++i) {
      const std::string path = ElementOf("joints", static_cast<size_t>(i));
      const Joint& joint = scene_.model.joint(i);
      const double effort = scene_.efforts[static_cast<size_t>(i)];
      CheckRange(path + "effort", effort, -kMaxSceneNumber, kMaxSceneNumber, " N m or N");
      CheckRange(path + "damping", joint.damping, 0, kMaxSceneNumber, " N m s or N s/m");
      CheckRange(path + "stiffness", joint.stiffness, 0, kMaxSceneNumber, " N m/rad or N/m");
      CheckRange(path + "rest", joint.rest_position, -kMaxSceneNumber, kMaxSceneNumber, " rad or m");
      CheckRange(path + "mass_kg", joint.mass, 0, kMaxSceneNumber, " kg");
      const int iq = scene_.model.q_index(i), iv = scene_.model.v_index(i);
      for (int c = 0; c < PositionCount(joint.type); ++c) {
        CheckRange(path + "initial.position", scene_.q[iq + c], -kMaxSceneNumber, kMaxSceneNumber, " rad or m");
      }
      for (int c = 0; c < VelocityCount(joint.type); ++c) {
        CheckRange(path + "initial.velocity", scene_.v[iv + c], -kMaxSceneNumber, kMaxSceneNumber, " rad/s or m/s");
      }
      if (joint.kind().is_free() && !(scene_.q.segment<4>(iq).norm() > 1e-6)) {
        Refuse(path + "initial.orientation", scene_.q.segment<4>(iq).transpose(),
               "must be a quaternion w x y z of length above 1e-6 (it is normalised)");
      }
    }
  }

  void CheckGround() {
    for (size_t i = 0; i < scene_.ground.size(); ++i) {
      const std::string path = ElementOf("ground", i);
      const GroundMotion& motion = scene_.ground[i];
      CheckVector(path + "velocity_m_s", motion.velocity, " m/s");
      CheckVector(path + "acceleration_m_s2", motion.acceleration, " m/s²");
      CheckVector(path + "amplitude_m", motion.amplitude, " m");
      CheckRange(path + "frequency_hz", motion.frequency, 0, 1e6, " Hz");
      CheckRange(path + "phase_rad", motion.phase, -1e3, 1e3, " rad");
      CheckVector(path + "pivot_m", motion.pivot, " m");
      CheckRange(path + "rate_rad_s", motion.rate, -1e6, 1e6, " rad/s");
      CheckRange(path + "angular_acceleration_rad_s2", motion.angular_acceleration, -1e6, 1e6, " rad/s²");
      CheckRange(path + "swing_rad", motion.swing, -100, 100, " rad");
      CheckRange(path + "swing_frequency_hz", motion.swing_frequency, 0, 1e6, " Hz");
      CheckRange(path + "swing_phase_rad", motion.swing_phase, -1e3, 1e3, " rad");
      if (!(motion.axis.allFinite() && std::abs(motion.axis.norm() - 1) <= 1e-9)) {
        Refuse(path + "axis", motion.axis.transpose(), "must be a finite vector that is not zero");
      }
    }
  }

  void CheckContacts() {
    for (size_t k = 0; k < scene_.contacts.size(); ++k) {
      const std::string path = ElementOf("contacts", k);
      const SceneContact& contact = scene_.contacts[k];
      if (!(contact.friction > 0)) Refuse(path + "friction", contact.friction, "must be larger than 0");
      if (contact.friction_loss == FrictionLoss::kSlide) CheckSliding(path, contact);
      if (contact.bilateral && !contact.active) {
        Refuse(path + "bilateral", "true", "must be false for a contact that is not active at the start");
      }
      for (size_t g = 0; g < contact.gates.size(); ++g) {
        const Gate& gate = contact.gates[g];
        const std::string gate_path = path + ElementOf("gates", g);
        if (!(gate.min <= gate.max))
          Refuse(gate_path + "min", gate.min, "must not be larger than max, neither may be NaN");
        if (scene_.model.joint(gate.joint).kind().is_free()) {
          Refuse(gate_path + "joint", scene_.model.joint(gate.joint).name, "must have one degree of freedom");
        }
      }
    }
  }

  void CheckSliding(const std::string& path, const SceneContact& contact) {
    const auto refuse = [&](const char* rule) { Refuse(path + "friction_loss", "FRICTION_LOSS_SLIDE", rule); };
    if (contact.friction == kInfinity) refuse("needs a finite coefficient `friction`");
    if (contact.contact.grip == Grip::kFrictionless) refuse("needs a grip; GRIP_FRICTIONLESS slides without friction");
    if (contact.contact.no_spin) refuse("cannot be combined with no_spin: a contact that slides holds no spin");
    if (contact.bilateral) refuse("cannot be combined with bilateral: friction follows a force that pushes");
  }

  void CheckOptions() {
    CheckVector("gravity_m_s2", scene_.gravity, " m/s²");
    const SimulationOptions& options = scene_.options;
    if (!(options.duration > 0 && options.duration <= 1e7)) {
      Refuse("duration_s", options.duration, "must be larger than 0 and at most 1e7 s");
    } else if (!(options.output_step > 0 && options.output_step <= options.duration)) {
      Refuse("output_step_s", options.output_step, "must be larger than 0 and at most duration_s");
    } else if (options.duration / options.output_step > kMaxSamples) {
      Refuse("output_step_s", options.output_step, "makes more than 2000000 samples; enlarge it or shorten duration_s");
    }
    CheckRange("tolerance", options.tolerance, 1e-14, 1e-2, "");
    if (options.absolute_tolerance) CheckRange("absolute_tolerance", *options.absolute_tolerance, 1e-30, 1e-2, "");
    CheckRange("drift.frequency_1_s", options.baumgarte.frequency, 0, 1e6, " 1/s");
    CheckRange("drift.damping", options.baumgarte.damping, 0, 1e3, "");
    CheckRange("drift.slip_rate_1_s", options.baumgarte.slip_rate, 0, 1e6, " 1/s");
    CheckRange("max_steps", options.max_steps, 1, 1e9, "");
    CheckRange("max_events", options.max_events, 1, 1e6, "");
    CheckRange("stop_after_impacts", options.stop_after_impacts, 0, 1e6, "");
  }

  // Every motion must move mass: the factor of M, scaled to a unit diagonal, says how far it is from that.
  void CheckMass() {
    const BodyDynamics dynamics(scene_.model);
    BodyDynamics::State state;
    BodyDynamics::Workspace workspace;
    MatrixX mass;
    dynamics.ComputeState(scene_.q, scene_.v, &state);
    dynamics.MassMatrix(state, &workspace, &mass);
    for (int i = 0; i < scene_.model.size(); ++i) {
      for (int c = 0; c < VelocityCount(scene_.model.joint(i).type); ++c) {
        const int j = scene_.model.v_index(i) + c;
        if (!(mass(j, j) > 0)) {
          return Refuse(ElementOf("joints", static_cast<size_t>(i)) + "mass_kg", scene_.model.joint(i).mass,
                        "this joint moves no inertia; give its link, or one that it carries, mass and inertia");
        }
      }
    }
    const VectorX scale = mass.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LLT<MatrixX> factor(scale.asDiagonal() * mass * scale.asDiagonal());
    if (factor.info() != Eigen::Success || !(factor.matrixLLT().diagonal().minCoeff() > 1e-7)) {
      Refuse("joints", "a tree whose mass matrix is singular at the start",
             "some combination of joint motions moves no inertia; give the links mass and inertia");
    }
  }

  const SimulationScene& scene_;
  Violations violations_;
};

}  // namespace

Violations CheckScene(const SimulationScene& scene) { return SceneChecker(scene).Run(); }

}  // namespace rollgait
