#include "bench/verdict_audit/kinematics.h"

#include <Eigen/Geometry>

#include "bench/verdict_audit/smooth_body.h"

namespace rollgait::audit {

std::vector<LinkPose> Poses(const Model& model, const VectorX& q, const VectorX& v) {
  std::vector<LinkPose> poses(static_cast<size_t>(model.size()));
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    LinkPose parent{Matrix3::Identity(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    if (joint.parent >= 0) parent = poses[static_cast<size_t>(joint.parent)];
    const Matrix3 R_WJ = parent.R_WL * joint.R_PJ;
    LinkPose& pose = poses[static_cast<size_t>(i)];
    pose.axis = R_WJ * joint.axis;
    const bool turns = joint.kind().turns;
    const double advance = joint.Advance();
    const Vector3 arm = parent.R_WL * joint.p_PJ + pose.axis * (advance * q[i]);
    pose.p_WL = parent.p_WL + arm;
    pose.R_WL = turns ? Matrix3(R_WJ * Eigen::AngleAxisd(q[i], joint.axis).toRotationMatrix()) : R_WJ;
    pose.w_WL = parent.w_WL;
    pose.v_WL = parent.v_WL + parent.w_WL.cross(arm);
    if (turns) pose.w_WL += pose.axis * v[i];
    pose.v_WL += pose.axis * (advance * v[i]);
  }
  return poses;
}

LowestPoint FindLowestPoint(const ContactSurface& contact, const std::vector<LinkPose>& poses) {
  const LinkPose& link = poses[static_cast<size_t>(contact.joint)];
  const Matrix3 R_WE = link.R_WL * contact.R_LE;
  const Vector3 above = BodyOf(contact.surface).Furthest(R_WE.transpose() * Vector3::UnitZ());
  LowestPoint lowest;
  lowest.point = link.p_WL + link.R_WL * contact.p_LE - R_WE * above;
  lowest.velocity = link.v_WL + link.w_WL.cross(lowest.point - link.p_WL);
  return lowest;
}

MatrixX PointJacobian(const Model& model, const std::vector<LinkPose>& poses, int link, const Vector3& point) {
  MatrixX jacobian = MatrixX::Zero(3, model.size());
  for (int i = link; i >= 0; i = model.parent(i)) {
    const LinkPose& pose = poses[static_cast<size_t>(i)];
    jacobian.col(i) = model.joint(i).Advance() * pose.axis;
    if (model.joint(i).kind().turns) jacobian.col(i) += pose.axis.cross(point - pose.p_WL);
  }
  return jacobian;
}

double Energy(const Model& model, const std::vector<LinkPose>& poses, const Vector3& gravity) {
  double energy = 0;
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    const LinkPose& pose = poses[static_cast<size_t>(i)];
    const Vector3 arm = pose.R_WL * joint.center_of_mass;
    const Vector3 velocity = pose.v_WL + pose.w_WL.cross(arm);
    const Vector3 turn = pose.R_WL.transpose() * pose.w_WL;
    energy += 0.5 * joint.mass * velocity.squaredNorm() + 0.5 * turn.dot(joint.inertia * turn) -
              joint.mass * gravity.dot(pose.p_WL + arm);
  }
  return energy;
}

Vector3 Momentum(const Model& model, const std::vector<LinkPose>& poses) {
  Vector3 momentum = Vector3::Zero();
  for (int i = 0; i < model.size(); ++i) {
    const LinkPose& pose = poses[static_cast<size_t>(i)];
    momentum += model.joint(i).mass * (pose.v_WL + pose.w_WL.cross(pose.R_WL * model.joint(i).center_of_mass));
  }
  return momentum;
}

}  // namespace rollgait::audit
