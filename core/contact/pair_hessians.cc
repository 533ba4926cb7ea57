#include "core/contact/pair_hessians.h"

#include <Eigen/Geometry>

#include "core/contact/pair_expansion.h"
#include "core/multibody/spatial.h"

namespace rollgait {
namespace {

Matrix12 Contracted(const std::array<Matrix12, 3>& second, const Vector3& y) {
  return y[0] * second[0] + y[1] * second[1] + y[2] * second[2];
}

// a ⊗ b + b ⊗ a, summed over the components of two vectors whose product is differentiated twice.
Matrix24 Mixed(const Matrix3x24& a, const Matrix3x24& b) {
  const Matrix24 product = a.transpose() * b;
  return product + product.transpose();
}

}  // namespace

// With D_k the derivative along e_k in world axes, [D_k, D_l] = D of θ_l × θ_k, and H the symmetric part of D_k D_l:
//   ½ (D_k D_l + D_l D_k) D_ξ X = D_ξ (H[k, l]) + H[ω × θ_k, l] + H[k, ω × θ_l].
template <typename MakeExpansion>
void PairHessians::Complete(bool on_plane, const FrameMotion& body_1, const FrameMotion& body_2,
                            const MakeExpansion& expand) {
  on_plane_ = on_plane;
  one_ = body_1;
  two_ = body_2;
  const auto moving = expand();
  exist_ = kinematics_.regular && moving.order() == 2;
  if (!exist_) return;
  slip_ = ComputeSlipDerivatives(on_plane, kinematics_, body_1, body_2, rates_);
  std::array<Change<Dual>, 12> changes;
  for (int k = 0; k < 12; ++k) moving.First(Vector12::Unit(k), &changes[static_cast<size_t>(k)]);
  const auto store = [](const Eigen::Matrix<Dual, 3, 1>& value, int k, int l, Rate* rate) {
    for (int i = 0; i < 3; ++i) {
      Matrix12& matrix = rate->rate_second[static_cast<size_t>(i)];
      matrix(k, l) = matrix(l, k) = value[i].d;
    }
  };
  for (int k = 0; k < 12; ++k) {
    for (int l = 0; l <= k; ++l) {
      const SecondChange<Dual> second = moving.Second(changes[static_cast<size_t>(k)], changes[static_cast<size_t>(l)]);
      store(second.normal, k, l, &normal_);
      store(second.p_1, k, l, &point_1_);
      store(second.p_2, k, l, &point_2_);
    }
  }
  normal_.first = configuration_.normal, normal_.second = configuration_.normal_second;
  point_1_.first = configuration_.p_1, point_1_.second = configuration_.p_1_second;
  point_2_.first = configuration_.p_2, point_2_.second = configuration_.p_2_second;
  Matrix12 turned = Matrix12::Zero();  // e_k -> ω × θ_k
  turned.block<3, 3>(3, 3) = Skew(body_1.w_WB);
  turned.block<3, 3>(9, 9) = Skew(body_2.w_WB);
  for (Rate* rate : {&normal_, &point_1_, &point_2_}) {
    for (size_t i = 0; i < 3; ++i) {
      const Matrix12 along = rate->second[i] * turned;
      rate->rate_second[i] += along + along.transpose();
    }
  }
}

PairHessians PairHessians::OnPlane(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                   const FrameMotion& plane_frame) {
  PairHessians result;
  result.kinematics_ = ComputePlaneContact(surface, body, plane, plane_frame);
  result.configuration_ = ComputePlaneDerivatives(surface, body, plane, plane_frame, 2);
  result.rates_ = ComputePlaneRateDerivatives(surface, body, plane, plane_frame);
  result.Complete(true, body, plane_frame, [&] { return PlaneExpansion<Dual>(surface, body, plane, plane_frame, 2); });
  return result;
}

PairHessians PairHessians::OfSurfaces(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                      const PlacedSurface& surface_2, const FrameMotion& body_2,
                                      const Separation& separation) {
  PairHessians result;
  result.kinematics_ = ComputeSurfaceContact(surface_1, body_1, surface_2, body_2, separation);
  result.configuration_ = ComputeSurfacePairDerivatives(surface_1, body_1, surface_2, body_2, separation, 2);
  result.rates_ = ComputeSurfacePairRateDerivatives(surface_1, body_1, surface_2, body_2, separation);
  result.Complete(false, body_1, body_2,
                  [&] { return SurfaceExpansion<Dual>(surface_1, body_1, surface_2, body_2, separation, 2); });
  return result;
}

Matrix3x24 PairHessians::Joined(const Matrix3x12& by_pose, const Matrix3x12& by_twist) {
  Matrix3x24 joined;
  joined << by_pose, by_twist;
  return joined;
}

Matrix24 PairHessians::OfConfiguration(const std::array<Matrix12, 3>& second, const Vector3& y) {
  Matrix24 hessian = Matrix24::Zero();
  hessian.topLeftCorner<12, 12>() = Contracted(second, y);
  return hessian;
}

// D_k (X_ζ e_l) = H[k, l] + ½ X_ζ (θ_l × θ_k).
Matrix24 PairHessians::OfRate(const Rate& rate, const Vector3& y) {
  Matrix12 mixed = Contracted(rate.second, y);
  const Vector12 first = rate.first.transpose() * y;
  for (const int body : {3, 9}) mixed.block<3, 3>(body, body) += 0.5 * Skew(first.segment<3>(body));
  Matrix24 hessian = Matrix24::Zero();
  hessian.topLeftCorner<12, 12>() = Contracted(rate.rate_second, y);
  hessian.topRightCorner<12, 12>() = mixed;
  hessian.bottomLeftCorner<12, 12>() = mixed.transpose();
  return hessian;
}

// y · (ω_1 × r_1 − ω_2 × r_2) with the second index a twist, and r_i by the first.
Matrix12 PairHessians::Turning(const Vector3& y) const {
  Matrix12 turning = Matrix12::Zero();
  turning.middleCols<3>(3) = slip_.lever_1.transpose() * Skew(y);
  turning.rightCols<3>() = -slip_.lever_2.transpose() * Skew(y);
  return turning;
}

Matrix24 PairHessians::Slip(const Vector3& y) const {
  Matrix24 hessian =
      OfConfiguration(point_1_.second, y.cross(one_.w_WB)) - OfConfiguration(Arm2().second, y.cross(two_.w_WB));
  const Matrix12 turning = Turning(y);
  hessian.topRightCorner<12, 12>() = turning;
  hessian.bottomLeftCorner<12, 12>() = turning.transpose();
  return hessian;
}

Matrix24 PairHessians::Drift(const Vector3& y) const {
  Matrix24 hessian = OfConfiguration(point_1_.second, y.cross(one_.alpha_WB)) -
                     OfConfiguration(Arm2().second, y.cross(two_.alpha_WB)) + OfRate(point_1_, y.cross(one_.w_WB)) -
                     OfRate(Arm2(), y.cross(two_.w_WB));
  // And ω_i by the second index, with ṙ_i by poses and by twists.
  Matrix12 by_pose = Matrix12::Zero();
  by_pose.middleCols<3>(3) = (rates_.p_dot_1.transpose() * Skew(y));
  by_pose.rightCols<3>() = -((on_plane_ ? rates_.p_dot_1 : rates_.p_dot_2).transpose() * Skew(y));
  hessian.topRightCorner<12, 12>() += by_pose;
  hessian.bottomLeftCorner<12, 12>() += by_pose.transpose();
  const Matrix12 turning = Turning(y);
  hessian.bottomRightCorner<12, 12>() += turning + turning.transpose();
  return hessian;
}

RowVector24 PairHessians::GapDerivative() const {
  RowVector24 derivative = RowVector24::Zero();
  derivative.head<12>() = configuration_.gap;
  return derivative;
}

RowVector24 PairHessians::GapRateDerivative() const {
  return kinematics_.normal.transpose() * SlipDerivative() + kinematics_.slip.transpose() * NormalDerivative();
}

RowVector24 PairHessians::GapAccelerationDerivative() const {
  return kinematics_.normal.transpose() * DriftDerivative() + kinematics_.drift.transpose() * NormalDerivative() +
         kinematics_.normal_dot.transpose() * SlipDerivative() + kinematics_.slip.transpose() * NormalRateDerivative();
}

Matrix24 PairHessians::Gap() const {
  Matrix24 hessian = Matrix24::Zero();
  hessian.topLeftCorner<12, 12>() = configuration_.gap_second;
  return hessian;
}

// φ̇ = n · w
Matrix24 PairHessians::GapRate() const {
  return Slip(kinematics_.normal) + Normal(kinematics_.slip) + Mixed(NormalDerivative(), SlipDerivative());
}

// φ̈ = n · ẇ + ṅ · w
Matrix24 PairHessians::GapAcceleration() const {
  return Drift(kinematics_.normal) + Normal(kinematics_.drift) + Mixed(NormalDerivative(), DriftDerivative()) +
         Slip(kinematics_.normal_dot) + NormalRate(kinematics_.slip) + Mixed(NormalRateDerivative(), SlipDerivative());
}

}  // namespace rollgait
