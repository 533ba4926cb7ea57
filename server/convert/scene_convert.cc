#include "server/convert/scene_convert.h"

#include <Eigen/Geometry>
#include <map>
#include <utility>

#include "core/multibody/joint_number.h"
#include "server/convert/joint_convert.h"
#include "server/convert/scene_decoding.h"

namespace rollgait::server {
namespace {

// How Model::Create names fields, and how the scene does.
std::string SceneField(std::string field) {
  static const std::map<std::string, std::string> kNames = [] {
    std::map<std::string, std::string> names = {{"p_PJ", "origin_m"},
                                                {"R_PJ", "orientation"},
                                                {"center_of_mass", "center_of_mass_m"},
                                                {"inertia", "inertia_kg_m2"}};
    for (const JointNumber& number : kJointNumbers) {
      if (number.scene_field != nullptr) names[number.name] = number.scene_field;
    }
    return names;
  }();
  const size_t dot = field.rfind('.');
  if (dot == std::string::npos) return field;
  const auto name = kNames.find(field.substr(dot + 1));
  return name == kNames.end() ? field : field.substr(0, dot + 1) + name->second;
}

class SceneDecoder {
 public:
  explicit SceneDecoder(const v1::SimulationScene& message) : message_(message), decoding_(message) {}

  Result<SimulationScene> Decode() {
    if (message_.joints_size() > kMaxSceneJoints || message_.contacts_size() > kMaxSceneContacts ||
        message_.ground_size() >= kMaxSceneGrounds) {
      decoding_.Refuse("joints", "the scene has more than 64 joints, 16 contacts or 15 ground frames; leave some out");
      return decoding_.violations();
    }
    std::vector<rollgait::Joint> joints;
    for (int i = 0; i < message_.joints_size(); ++i) joints.push_back(DecodeJoint(i));
    if (!decoding_.violations().empty()) return decoding_.violations();
    Result<Model> model = Model::Create(std::move(joints));
    if (!model.ok()) {
      for (const Violation& violation : model.violations())
        decoding_.Refuse(SceneField(violation.field), violation.message);
      return decoding_.violations();
    }
    SimulationScene scene{message_.name(), std::move(model).value(), {}, {GroundMotion{}}, {}, {}, {}, {}, {}, -1, {}};
    DecodeStateAndForces(&scene);
    for (int i = 0; i < message_.ground_size(); ++i) DecodeGround(i, &scene);
    for (int k = 0; k < message_.contacts_size(); ++k) {
      scene.contacts.push_back(DecodeContact(message_.contacts(k), k, &decoding_));
    }
    DecodeOptions(&scene);
    if (!decoding_.violations().empty()) return decoding_.violations();
    Violations wrong = CheckScene(scene);
    for (Violation& violation : wrong) {
      // Frame 0 is the world, which the message does not list.
      if (violation.field.rfind("ground[", 0) == 0) {
        const int index = std::stoi(violation.field.substr(7)) - 1;
        violation.field = "ground[" + std::to_string(index) + violation.field.substr(violation.field.find(']'));
      }
    }
    if (!wrong.empty()) return wrong;
    return scene;
  }

 private:
  rollgait::Joint DecodeJoint(int i) {
    const v1::SceneJoint& encoded = message_.joints(i);
    const std::string path = "joints[" + std::to_string(i) + "].";
    rollgait::Joint joint;
    joint.name = joint.link = encoded.name();
    const JointKind* const kind = DecodeJointType(encoded.type());
    if (kind == nullptr) {
      decoding_.Refuse(path + "type", "enum value " + std::to_string(encoded.type()) + "; must be " +
                                          JointTypeNames(JointsOf::kScene));
    } else {
      joint.type = kind->type;
    }
    DecodeJointNumbers(encoded, &joint);
    if (!encoded.parent().empty()) joint.parent = decoding_.Joint(path + "parent", encoded.parent());
    joint.p_PJ = decoding_.Point(path + "origin_m", encoded.origin_m());
    joint.R_PJ =
        decoding_.Rotation(path + "orientation", encoded.has_orientation(), encoded.orientation()).toRotationMatrix();
    joint.axis = decoding_.Direction(path + "axis", encoded.has_axis(), encoded.axis(), Vector3::UnitZ());
    joint.center_of_mass = decoding_.Point(path + "center_of_mass_m", encoded.center_of_mass_m());
    if (encoded.inertia_kg_m2_size() == 6) {
      const auto& e = encoded.inertia_kg_m2();
      joint.inertia << e[0], e[3], e[4], e[3], e[1], e[5], e[4], e[5], e[2];
    } else if (encoded.inertia_kg_m2_size() != 0) {
      decoding_.Refuse(path + "inertia_kg_m2", "has " + std::to_string(encoded.inertia_kg_m2_size()) +
                                                   " entries; must have 6 (xx, yy, zz, xy, xz, yz) or none");
    }
    if (!encoded.mirror_joint().empty()) {
      joint.mirror_joint = decoding_.Joint(path + "mirror_joint", encoded.mirror_joint());
    }
    return joint;
  }

  void DecodeStateAndForces(SimulationScene* scene) {
    scene->q.resize(scene->model.nq());
    scene->v.resize(scene->model.nv());
    for (int i = 0; i < message_.joints_size(); ++i) {
      const v1::SceneJoint& joint = message_.joints(i);
      const v1::SceneJointState& state = joint.initial();
      scene->efforts.push_back(joint.effort());
      const int iq = scene->model.q_index(i), iv = scene->model.v_index(i);
      if (!scene->model.joint(i).kind().is_free()) {
        scene->q[iq] = state.position();
        scene->v[iv] = state.velocity();
        continue;
      }
      const Eigen::Quaterniond rotation = decoding_.Rotation("joints[" + std::to_string(i) + "].initial.orientation",
                                                             state.has_orientation(), state.orientation());
      scene->q.segment<4>(iq) << rotation.w(), rotation.x(), rotation.y(), rotation.z();
      scene->q.segment<3>(iq + 4) = DecodeVector(state.position_m());
      scene->v.segment<3>(iv) = DecodeVector(state.angular_velocity_rad_s());
      scene->v.segment<3>(iv + 3) = rotation.conjugate() * DecodeVector(state.velocity_m_s());
    }
  }

  void DecodeGround(int i, SimulationScene* scene) {
    const v1::GroundFrame& frame = message_.ground(i);
    GroundMotion motion;
    motion.velocity = DecodeVector(frame.velocity_m_s());
    motion.acceleration = DecodeVector(frame.acceleration_m_s2());
    motion.amplitude = DecodeVector(frame.amplitude_m());
    motion.frequency = frame.frequency_hz();
    motion.phase = frame.phase_rad();
    motion.axis =
        decoding_.Direction("ground[" + std::to_string(i) + "].axis", frame.has_axis(), frame.axis(), Vector3::UnitZ());
    motion.pivot = DecodeVector(frame.pivot_m());
    motion.rate = frame.rate_rad_s();
    motion.angular_acceleration = frame.angular_acceleration_rad_s2();
    motion.swing = frame.swing_rad();
    motion.swing_frequency = frame.swing_frequency_hz();
    motion.swing_phase = frame.swing_phase_rad();
    scene->ground.push_back(motion);
  }

  void DecodeOptions(SimulationScene* scene);

  const v1::SimulationScene& message_;
  SceneDecoding decoding_;
};

void SceneDecoder::DecodeOptions(SimulationScene* scene) {
  scene->gravity = message_.has_gravity_m_s2() ? DecodeVector(message_.gravity_m_s2()) : Vector3(0, 0, -9.81);
  for (int i = 0; i < message_.adjusted_joints_size(); ++i) {
    scene->adjusted_joints.push_back(
        decoding_.Joint("adjusted_joints[" + std::to_string(i) + "]", message_.adjusted_joints(i)));
  }
  if (!message_.travel_joint().empty()) {
    scene->travel_joint = decoding_.Joint("travel_joint", message_.travel_joint());
  }
  SimulationOptions& options = scene->options;
  options.duration = message_.duration_s();
  options.output_step = message_.has_output_step_s() ? message_.output_step_s() : message_.duration_s() / 100;
  if (message_.has_tolerance()) options.tolerance = message_.tolerance();
  if (message_.has_absolute_tolerance()) options.absolute_tolerance = message_.absolute_tolerance();
  if (message_.has_max_steps()) options.max_steps = message_.max_steps();
  if (message_.has_max_events()) options.max_events = message_.max_events();
  options.stop_after_impacts = message_.stop_after_impacts();
  const v1::DriftControl& drift = message_.drift();
  options.baumgarte = {drift.frequency_1_s(), drift.damping(), drift.slip_rate_1_s()};
  switch (drift.kind()) {
    case v1::DriftControl::KIND_UNSPECIFIED:
    case v1::DriftControl::KIND_PROJECTION:
      options.drift = rollgait::DriftControl::kProjection;
      break;
    case v1::DriftControl::KIND_NONE:
      options.drift = rollgait::DriftControl::kNone;
      break;
    case v1::DriftControl::KIND_BAUMGARTE:
      options.drift = rollgait::DriftControl::kBaumgarte;
      break;
    default:
      decoding_.Refuse("drift.kind", "enum value " + std::to_string(drift.kind()) + " is not known; use a named one");
  }
}

}  // namespace

Result<SimulationScene> DecodeScene(const v1::SimulationScene& scene) { return SceneDecoder(scene).Decode(); }

}  // namespace rollgait::server
