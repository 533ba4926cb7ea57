#ifndef ROLLGAIT_TESTS_SUPPORT_ROLLING_BODY_H_
#define ROLLGAIT_TESTS_SUPPORT_ROLLING_BODY_H_

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/contact/contact_surface.h"
#include "core/multibody/model.h"

namespace rollgait {

// A single rigid body with an ellipsoidal surface around its frame origin, as a tree of six joints: base_x, base_y,
// base_z, then yaw about z, pitch about y, roll about x. Singular at a pitch of ±90°.
struct RollingBody {
  Model model;
  ContactSurface surface;
};

inline RollingBody MakeRollingBody(const Vector3& semi_axes, double mass, const Vector3& center_of_mass,
                                   const Matrix3& inertia) {
  const char* names[] = {"base_x", "base_y", "base_z", "yaw", "pitch", "roll"};
  const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(),
                          Vector3::UnitZ(), Vector3::UnitY(), Vector3::UnitX()};
  std::vector<Joint> joints(6);
  for (int i = 0; i < 6; ++i) {
    joints[i].name = names[i];
    joints[i].link = std::string("link_") + names[i];
    joints[i].type = i < 3 ? JointType::kPrismatic : JointType::kRevolute;
    joints[i].axis = axes[i];
    joints[i].parent = i - 1;
  }
  joints[5].mass = mass;
  joints[5].center_of_mass = center_of_mass;
  joints[5].inertia = inertia;
  RollingBody body{Model::Create(std::move(joints)).value(), {}};
  body.surface.name = "surface";
  body.surface.joint = 5;
  body.surface.surface = Ellipsoid(semi_axes);
  return body;
}

// Joint positions and velocities of that body, rolling on z = 0 with the contact point (x, y), the orientation R (body
// -> world) and the angular velocity omega (world).
inline void SetRolling(const Vector3& semi_axes, const Matrix3& R, const Vector3& omega, double x, double y, VectorX* q,
                       VectorX* v) {
  const Vector3 scaled = semi_axes.cwiseProduct(-R.row(2).transpose());
  const Vector3 r = R * semi_axes.cwiseProduct(scaled) / scaled.norm();
  q->resize(6);
  v->resize(6);
  q->head(3) = Vector3(x, y, 0) - r;
  (*q)[3] = std::atan2(R(1, 0), R(0, 0));
  (*q)[4] = std::asin(-R(2, 0));
  (*q)[5] = std::atan2(R(2, 1), R(2, 2));
  v->head(3) = -omega.cross(r);
  // omega = e_z ψ̇ + R_z e_y θ̇ + R_z R_y e_x φ̇.
  const Matrix3 R_z = Eigen::AngleAxisd((*q)[3], Vector3::UnitZ()).toRotationMatrix();
  const Matrix3 R_zy = R_z * Eigen::AngleAxisd((*q)[4], Vector3::UnitY()).toRotationMatrix();
  Matrix3 axes;
  axes << Vector3::UnitZ(), R_z.col(1), R_zy.col(0);
  v->tail(3) = axes.inverse() * omega;
}

// A row of the reference trajectories.
struct ReferenceRow {
  double t;
  Matrix3 R;           // body -> world
  Vector3 omega;       // rad/s, body axes
  double x, y;         // m, contact point
  Vector3 com, v_com;  // m, m/s
  Vector3 force;       // N, on the body
  double energy;       // J
};

// Reads tests/data/<file>: a comment line, a header line, rows.
inline std::vector<ReferenceRow> ReadReference(const std::string& path) {
  std::ifstream file(path);
  ROLLGAIT_CHECK(file.good());
  std::string line;
  std::getline(file, line);
  std::getline(file, line);
  std::vector<ReferenceRow> rows;
  while (std::getline(file, line)) {
    std::vector<double> c;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) c.push_back(std::stod(field));
    ROLLGAIT_CHECK(c.size() == 22);
    rows.push_back({c[0], Eigen::Quaterniond(c[1], c[2], c[3], c[4]).normalized().toRotationMatrix(),
                    Vector3(c[5], c[6], c[7]), c[8], c[9], Vector3(c[10], c[11], c[12]), Vector3(c[13], c[14], c[15]),
                    Vector3(c[16], c[17], c[18]), c[21]});
  }
  return rows;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_ROLLING_BODY_H_
