#include "core/geometry/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

template <typename Body>
concept Walks = requires(const Body& body) {
  body.Walking();
};

template <typename Body>
concept KnowsTangents = requires(const Body& body, const Eigen::Matrix<double, 3, 2>& tangents) {
  body.TangentHessian(Vector3(), tangents);
};

template <typename... Bodies>
std::vector<std::string> WalkingNames(const std::variant<Bodies...>*) {
  std::vector<std::string> names;
  const auto add = [&names](const auto* body) {
    using Body = std::remove_cvref_t<decltype(*body)>;
    if constexpr (Walks<Body>) names.emplace_back(Body::kWalks);
  };
  (add(static_cast<const Bodies*>(nullptr)), ...);
  return names;
}

}  // namespace

Surface Surface::MovedTo(const Vector3& center) const {
  ROLLGAIT_CHECK(center.allFinite());
  Surface moved = *this;
  moved.center_ = center;
  moved.plain_ = moved.rounding_ == 0 && center.isZero(0);
  return moved;
}

Surface Surface::Rounded(double radius) const {
  ROLLGAIT_CHECK(std::isfinite(radius) && radius >= 0);
  Surface rounded = *this;
  rounded.rounding_ += radius;
  rounded.plain_ = rounded.rounding_ == 0 && center_.isZero(0);
  return rounded;
}

double Surface::Support(const Vector3& nu) const {
  const double h = std::visit([&](const auto& body) { return body.Support(nu); }, kind_);
  return plain_ ? h : h + nu.dot(center_) + rounding_ * nu.norm();
}

Vector3 Surface::SupportPoint(const Vector3& nu) const {
  const Vector3 x = std::visit([&](const auto& body) { return body.SupportPoint(nu); }, kind_);
  return plain_ ? x : Vector3(x + center_ + rounding_ * nu.normalized());
}

Matrix3 Surface::SupportHessian(const Vector3& nu) const {
  if (plain_) return std::visit([&](const auto& body) { return body.SupportHessian(nu); }, kind_);
  SupportJet jet;
  Evaluate(nu, 2, &jet);
  return jet.S;
}

Matrix3 Surface::SupportThird(const Vector3& nu, const Vector3& u) const {
  SupportJet jet;
  Evaluate(nu, 3, &jet);
  return jet.order >= 3 ? jet.Third(u) : jet.T[0];
}

Matrix3 Surface::SupportFourth(const Vector3& nu, const Vector3& u, const Vector3& w) const {
  SupportJet jet;
  Evaluate(nu, 4, &jet);
  return jet.order >= 4 ? jet.Fourth(u, w) : jet.Q[0];
}

Vector3 Surface::RollingVelocity(const Vector3& nu, const Vector3& omega) const {
  const Vector3 velocity = std::visit([&](const auto& body) { return body.RollingVelocity(nu, omega); }, kind_);
  return plain_ ? velocity : Vector3(velocity + rounding_ * nu.cross(omega));
}

Eigen::Matrix2d Surface::TangentHessian(const Vector3& nu, const Eigen::Matrix<double, 3, 2>& tangents) const {
  Eigen::Matrix2d block;
  std::visit(
      [&](const auto& body) {
        if constexpr (KnowsTangents<std::remove_cvref_t<decltype(body)>>) {
          block = body.TangentHessian(nu, tangents);
        } else {
          SupportJet jet;
          body.Evaluate(nu, 2, &jet);
          if (jet.order < 2) {
            block.setConstant(kInfinity);
          } else {
            block = tangents.transpose() * jet.S * tangents;
          }
        }
      },
      kind_);
  block.diagonal().array() += rounding_;
  return block;
}

void Surface::Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
  ROLLGAIT_CHECK(order >= 1 && order <= 4);
  std::visit([&](const auto& body) { body.Evaluate(nu, order, jet); }, kind_);
  if (plain_) return;
  if (rounding_ > 0) AddBall(nu, rounding_, order, jet);
  jet->h += nu.dot(center_);
  jet->x += center_;
}

const Vector3* Surface::semi_axes() const {
  if (!plain_) return nullptr;
  return std::visit(
      [](const auto& body) -> const Vector3* {
        if constexpr (Walks<std::remove_cvref_t<decltype(body)>>) return &body.semi_axes();
        return nullptr;
      },
      kind_);
}

std::optional<WalkingShape> Surface::walking() const {
  if (!plain_) return std::nullopt;
  return std::visit(
      [](const auto& body) -> std::optional<WalkingShape> {
        if constexpr (Walks<std::remove_cvref_t<decltype(body)>>) return body.Walking();
        return std::nullopt;
      },
      kind_);
}

std::vector<std::string> Surface::WalkingKinds() { return WalkingNames(static_cast<const Kind*>(nullptr)); }

double Surface::Size() const {
  double size = 0;
  for (int i = 0; i < 3; ++i) {
    for (double sign : {1.0, -1.0}) size = std::max(size, Support(sign * Vector3::Unit(i)));
  }
  return size;
}

double SupportDifference(const Surface& first, const Matrix3& R_first, const Surface& second, const Matrix3& R_second) {
  double largest = 0;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vector3 nu = Vector3(x, y, z).normalized();
        const double difference = first.Support(R_first.transpose() * nu) - second.Support(R_second.transpose() * nu);
        if (!(std::abs(difference) <= largest)) largest = std::abs(difference);
      }
    }
  }
  return largest;
}

}  // namespace rollgait
