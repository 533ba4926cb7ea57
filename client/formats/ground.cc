#include "client/formats/ground.h"

#include <cmath>

#include "client/text.h"

namespace rollgait::client {

Eigen::Vector3d Ground::Gravity() const {
  return gravity_m_s2 * Eigen::Vector3d(-std::sin(slope_rad), 0, -std::cos(slope_rad));
}

std::string Ground::Describe() const {
  return "The ground is a plane; a slope turns gravity, not the ground: slope " + FormatNumber(slope_rad * 180 / kPi) +
         " deg (uphill is positive), gravity " + FormatNumber(gravity_m_s2) + " m/s^2, friction " +
         FormatNumber(friction) + ".";
}

Ground GroundOf(const v1::Solve& solve) {
  Ground ground;
  ground.slope_rad = solve.spec().slope_rad();
  if (solve.spec().has_gravity_m_s2()) ground.gravity_m_s2 = solve.spec().gravity_m_s2();
  if (solve.spec().ground_contact().has_friction_coefficient()) {
    ground.friction = solve.spec().ground_contact().friction_coefficient();
  }
  return ground;
}

}  // namespace rollgait::client
