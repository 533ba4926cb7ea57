#ifndef ROLLGAIT_TESTS_SUPPORT_ROLLING_SCENES_H_
#define ROLLGAIT_TESTS_SUPPORT_ROLLING_SCENES_H_

#include <Eigen/Geometry>
#include <utility>

#include "core/simulation/scene.h"

namespace rollgait {

// A free body with one surface on the plane z = 0 of a ground frame. The link frame is the surface's.
struct BodyOnPlane {
  Surface surface = Sphere(1);
  double mass = 1;
  Vector3 center_of_mass = Vector3::Zero();
  Matrix3 inertia = Matrix3::Identity();
  Vector3 gravity{0, 0, -9.81};
  double sigma = 0;  // N m s, couple −sigma ω
  GroundMotion ground;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector3 omega_body = Vector3::Zero();
  Vector3 contact_point = Vector3::Zero();  // z is found
};

// The scene at t = 0 in contact and rolling (the translation of the body is an adjusted joint).
inline SimulationScene SceneOf(const BodyOnPlane& body) {
  Joint joint;
  joint.name = joint.link = "body";
  joint.type = JointType::kFree;
  joint.mass = body.mass;
  joint.center_of_mass = body.center_of_mass;
  joint.inertia = body.inertia;
  joint.damping = body.sigma;
  SimulationScene scene{"body", Model::Create({joint}).value(), {}, {}, {}, {}, {}, {}, {}, -1, {}};
  scene.efforts = {0};
  scene.ground = {GroundMotion{}, body.ground};
  SceneContact contact;
  contact.contact.name = "touch";
  contact.contact.surface.surface = body.surface;
  contact.contact.ground = 1;
  contact.active = true;
  scene.contacts = {contact};
  scene.gravity = body.gravity;
  const Eigen::Quaterniond q = body.orientation.normalized();
  const Vector3 nu = q.inverse() * Vector3(0, 0, -1);
  const Vector3 center = body.contact_point - q * body.surface.SupportPoint(nu);
  scene.q.resize(7);
  scene.q << q.w(), q.x(), q.y(), q.z(), center;
  scene.v = VectorX::Zero(6);
  scene.v.head<3>() = body.omega_body;
  scene.adjusted_joints = {0};
  return scene;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_ROLLING_SCENES_H_
