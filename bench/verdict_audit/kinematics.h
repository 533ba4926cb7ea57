// Poses, energies and momenta of a tree, computed from rollgait::Model by the audit itself.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_KINEMATICS_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_KINEMATICS_H_

#include <vector>

#include "core/contact/contact_surface.h"
#include "core/multibody/model.h"

namespace rollgait::audit {

// Where a link is and how it moves, world axes.
struct LinkPose {
  Matrix3 R_WL;
  Vector3 p_WL;        // m, origin
  Vector3 axis;        // of its joint, unit
  Vector3 w_WL, v_WL;  // rad/s; m/s, of the origin
};

// Of every link at positions q and velocities v (one number a joint each). Contract: no free joints.
std::vector<LinkPose> Poses(const Model& model, const VectorX& q, const VectorX& v);

// The lowest point of a surface.
struct LowestPoint {
  Vector3 point;     // m
  Vector3 velocity;  // m/s, of the material point of the link that is there
};

// Contract: the surface is an ellipsoid.
LowestPoint FindLowestPoint(const ContactSurface& contact, const std::vector<LinkPose>& poses);

// 3 × n: velocity of the material point of `link` at `point` per unit velocity of each joint, world axes.
MatrixX PointJacobian(const Model& model, const std::vector<LinkPose>& poses, int link, const Vector3& point);

// J, kinetic and potential, zero of the latter with every centre of mass at the origin.
double Energy(const Model& model, const std::vector<LinkPose>& poses, const Vector3& gravity);
// N s.
Vector3 Momentum(const Model& model, const std::vector<LinkPose>& poses);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_KINEMATICS_H_
