#include "client/formats/exact_number.h"

#include <Eigen/Geometry>
#include <charconv>

namespace rollgait::client {

std::string Exact(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value + 0.0);
  return error == std::errc() ? std::string(text, end) : "nan";
}

std::string Exact(const Eigen::Vector3d& vector) {
  return Exact(vector.x()) + " " + Exact(vector.y()) + " " + Exact(vector.z());
}

std::string ExactQuaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  q.normalize();
  return Exact(q.w()) + " " + Exact(Eigen::Vector3d(q.vec()));
}

}  // namespace rollgait::client
