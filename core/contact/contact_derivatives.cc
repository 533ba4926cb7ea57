#include "core/contact/contact_derivatives.h"

#include <algorithm>

#include "core/math/assign_dual.h"

namespace rollgait {
namespace {

const Vector3 kNormal = Vector3::UnitZ();

}  // namespace

template <typename T>
ContactDerivatives<T>::ContactDerivatives(const Model& model, const ContactSurface& contact) : contact_(contact) {
  for (int j = contact.joint; j >= 0; j = model.parent(j)) path_.push_back(j);
  std::reverse(path_.begin(), path_.end());
  axis_.resize(path_.size());
  dp_.resize(path_.size());
  delta_ = turn_ = dp_;
  ddp_.resize(path_.size() * path_.size());
}

template <typename T>
typename ContactDerivatives<T>::Field ContactDerivatives<T>::MakeField() const {
  return Field{std::vector<Vec6>(path_.size()), std::vector<Vec3>(path_.size())};
}

template <typename T>
void ContactDerivatives<T>::Update(const TreeDynamics& tree) {
  const int link = contact_.joint;
  const Vector6& twist = tree.twist(link);
  const Vector3 w = twist.head<3>();
  const Matrix3 R = tree.rotation(link) * contact_.R_LE;
  const Matrix3 dR = Skew(w) * R;
  AssignDual(rotation_, R, dR);
  const Vector3 center = tree.origin(link) + tree.rotation(link) * contact_.p_LE;
  const Vector3 dcenter = twist.tail<3>() + w.cross(center);
  const Vector3 nu = -R.transpose() * kNormal;
  const Vector3 dnu = -dR.transpose() * kNormal;
  AssignDual(nu_, nu, dnu);

  constexpr int kOrder = std::is_same_v<T, Dual> ? 3 : 2;
  contact_.surface.Evaluate(nu, kOrder, &jet_);
  const Vector3& x = jet_.x;
  const Matrix3& S = jet_.S;
  const Vector3 dx = S * dnu;
  AssignDual(surface_point_, x, dx);
  const Vector3 p = center + R * x;
  const Vector3 dp = dcenter + dR * x + R * dx;
  AssignDual(point_, p, dp);
  if constexpr (std::is_same_v<T, Dual>) {
    AssignDual(hessian_, S, jet_.Third(dnu));
  } else {
    hessian_ = S;
  }
  for (int k = 0; k < path_size(); ++k) {
    const Vector6& s = tree.axis(path_[k]);
    const Vector6 ds = CrossMotion(tree.twist(path_[k]), s);
    AssignDual(axis_[k], s, ds);
    const Vec3 theta = Angular(k);
    turn_[k] = rotation_.transpose() * theta.cross(kNormal.template cast<T>());
    delta_[k] = rotation_ * (hessian_ * turn_[k]);
    dp_[k] = At(axis_[k]) + delta_[k];
  }
}

template <typename T>
void ContactDerivatives<T>::UpdateSecond() {
  Vector3 nu, dnu = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    if constexpr (std::is_same_v<T, Dual>) {
      nu(i) = nu_(i).v;
      dnu(i) = nu_(i).d;
    } else {
      nu(i) = nu_(i);
    }
  }
  constexpr int kOrder = std::is_same_v<T, Dual> ? 4 : 3;
  contact_.surface.Evaluate(nu, kOrder, &jet_);
  for (int j = 0; j < 3; ++j) {
    if constexpr (std::is_same_v<T, Dual>) {
      AssignDual(third_[j], jet_.T[j], jet_.FourthOf(j, dnu));
    } else {
      third_[j] = jet_.T[j];
    }
  }
  const Vec3& n = kNormal.template cast<T>();
  for (int k = 0; k < path_size(); ++k) {
    const Vec3 theta_k = Angular(k);
    for (int m = 0; m <= k; ++m) {
      const Vec3 theta_m = Angular(m);
      // ∂δ_k/∂q_m = θ_m × δ_k − S(θ_k × (θ_m × n)) + T[θ_m × n](θ_k × n)
      const Vec3 inner = rotation_.transpose() * theta_k.cross(Vec3(theta_m.cross(n)));
      const Vec3 along = rotation_ * (ThirdApply(turn_[m], turn_[k]) - hessian_ * inner);
      ddp_[k * path_size() + m] =
          At(CrossMotion<T>(axis_[m], axis_[k])) + theta_k.cross(dp_[m]) + theta_m.cross(delta_[k]) + along;
    }
  }
}

template <typename T>
typename ContactDerivatives<T>::Vec3 ContactDerivatives<T>::ThirdApply(const Vec3& u, const Vec3& y) const {
  Vec3 result = third_[0] * y * u(0);
  result += third_[1] * y * u(1);
  result += third_[2] * y * u(2);
  return result;
}

template <typename T>
typename ContactDerivatives<T>::Vec3 ContactDerivatives<T>::JacobianDerivative(int m, int k) const {
  Vec3 turned = Angular(k).cross(dp_[m]);
  if (m > k) return turned;
  return At(CrossMotion<T>(axis_[m], axis_[k])) + turned;
}

template <typename T>
void ContactDerivatives<T>::ComputeField(const T* u, Field* field) const {
  const int last = path_size() - 1;
  for (int k = last; k >= 0; --k) {
    field->from[k] = axis_[k] * u[k];
    if (k < last) field->from[k] += field->from[k + 1];
  }
  const Vec3 spin = field->from[0].template head<3>();
  for (int k = 0; k <= last; ++k) {
    field->gradient[k] = At(CrossMotion<T>(axis_[k], field->from[k])) + spin.cross(dp_[k]);
  }
}

template <typename T>
T ContactDerivatives<T>::ContractedSecond(const Field& field, const Vec3& y, int m, int k) const {
  if (m > k) std::swap(m, k);
  const Vec6 turned_k = CrossMotion<T>(axis_[k], field.from[k]);
  const Vec3 spin = field.from[0].template head<3>();
  const Vec3 spin_m = Angular(m).cross(Vec3(field.from[m].template head<3>()));
  const Vec3 second = At(CrossMotion<T>(axis_[m], turned_k)) + Vec3(turned_k.template head<3>()).cross(dp_[m]) +
                      spin_m.cross(dp_[k]) + spin.cross(PointSecond(m, k));
  return y.dot(second);
}

template <typename T>
typename ContactDerivatives<T>::Vec3 ContactDerivatives<T>::SurfacePointSecond(int m, int k) const {
  if (m > k) std::swap(m, k);
  const Vec3& n = kNormal.template cast<T>();
  const Vec3 inner = rotation_.transpose() * Angular(k).cross(Vec3(Angular(m).cross(n)));
  return ThirdApply(turn_[m], turn_[k]) - hessian_ * inner;
}

template class ContactDerivatives<double>;
template class ContactDerivatives<Dual>;

}  // namespace rollgait
