#include "core/contact/rolling_kinematics.h"

#include <Eigen/Geometry>

#include "core/base/check.h"

namespace rollgait {

RollingContact ComputeRollingContact(const ContactSurface& surface, const BodyDynamics::State& state) {
  const BodyDynamics::Link& link = state[surface.joint];
  const Matrix3 R_WE = link.R_WL * surface.R_LE;
  const Vector3 p_LE_W = link.R_WL * surface.p_LE;
  const Vector3 omega = link.R_WL * link.twist.angular;
  const Vector3 v_WL = link.R_WL * link.twist.linear;

  const Vector3 nu = -R_WE.row(2).transpose();
  const Vector3 r = R_WE * surface.surface.SupportPoint(nu);  // origin of the surface -> P, world

  RollingContact contact;
  const Vector3 p_WE = link.p_WL + p_LE_W;
  contact.p_WP = p_WE + r;
  contact.gap = p_WE.z() - surface.surface.Support(nu);
  contact.slip = v_WL + omega.cross(p_LE_W + r);
  const Vector3 over_surface = R_WE * surface.surface.RollingVelocity(nu, R_WE.transpose() * omega);
  contact.point_velocity = contact.slip + over_surface;

  // Classical bias accelerations of the link, then of the material point P, then the rolling term.
  const Vector3 alpha = link.R_WL * link.bias.angular;
  const Vector3 acceleration = link.R_WL * link.bias.linear + omega.cross(v_WL);
  const Vector3 lever = p_LE_W + r;
  contact.drift = acceleration + alpha.cross(lever) + omega.cross(omega.cross(lever)) + omega.cross(over_surface);
  return contact;
}

void RollingJacobian(const BodyDynamics& dynamics, const ContactSurface& surface, const BodyDynamics::State& state,
                     const Vector3& point, int first_row, MatrixX* jacobian) {
  const int rows = static_cast<int>(surface.directions.size());
  ROLLGAIT_CHECK(first_row >= 0 && first_row + rows <= jacobian->rows() && jacobian->cols() == dynamics.size());
  jacobian->middleRows(first_row, rows).setZero();
  for (int j = surface.joint; j >= 0; j = dynamics.parent(j)) {
    const Vector3 axis = state[j].R_WL * dynamics.axis(j);
    const double advance = dynamics.advance(j);
    Vector3 column = dynamics.turns(j) ? Vector3(axis.cross(point - state[j].p_WL)) : Vector3(advance * axis);
    if (dynamics.turns(j) && advance != 0) column += advance * axis;
    for (int k = 0; k < rows; ++k) (*jacobian)(first_row + k, j) = column[surface.directions[k]];
  }
}

}  // namespace rollgait
