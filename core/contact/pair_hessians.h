#ifndef ROLLGAIT_CORE_CONTACT_PAIR_HESSIANS_H_
#define ROLLGAIT_CORE_CONTACT_PAIR_HESSIANS_H_

#include <array>

#include "core/contact/pair_derivatives.h"

namespace rollgait {

using Matrix3x24 = Eigen::Matrix<double, 3, 24>;
using RowVector24 = Eigen::Matrix<double, 1, 24>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;

// First and second derivatives of everything in PairKinematics by the 24 variables (ζ, ξ): poses along exp(ζ) and
// twists of the two frames, as in PairDerivatives. Twists in world axes keep their values while the poses change, and
// so do the accelerations of the frames; by the latter the drift has the derivative slip_by_twist. Second derivatives
// of vectors are contracted: y, a constant world vector, times the quantity. Multipliers λ on γ: Drift(λ). Exact,
// nothing by differences. Immutable. Source: contact-math 4 to 6, 8; docs/explanation/derivatives.md.
class PairHessians {
 public:
  // Contract: as ComputePlaneContact, ComputeSurfaceContact.
  static PairHessians OnPlane(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                              const FrameMotion& plane_frame);
  static PairHessians OfSurfaces(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                 const PlacedSurface& surface_2, const FrameMotion& body_2,
                                 const Separation& separation);

  // False where the surfaces have no fourth derivative of the support function at the contact point
  // (SupportJet::order). Everything below but the kinematics is a contract: exist().
  bool exist() const { return exist_; }
  const PairKinematics& kinematics() const { return kinematics_; }

  Matrix3x24 NormalDerivative() const { return Wide(configuration_.normal); }
  Matrix3x24 Point1Derivative() const { return Wide(configuration_.p_1); }
  Matrix3x24 Point2Derivative() const { return Wide(configuration_.p_2); }
  Matrix3x24 NormalRateDerivative() const { return Joined(rates_.normal_dot, configuration_.normal); }
  Matrix3x24 PointRate1Derivative() const { return Joined(rates_.p_dot_1, configuration_.p_1); }
  Matrix3x24 PointRate2Derivative() const { return Joined(rates_.p_dot_2, configuration_.p_2); }
  Matrix3x24 SlipDerivative() const { return Joined(slip_.slip_by_pose, slip_.slip_by_twist); }
  Matrix3x24 DriftDerivative() const { return Joined(slip_.drift_by_pose, slip_.drift_by_twist); }
  RowVector24 GapDerivative() const;
  RowVector24 GapRateDerivative() const;
  RowVector24 GapAccelerationDerivative() const;

  Matrix24 Normal(const Vector3& y) const { return OfConfiguration(configuration_.normal_second, y); }
  Matrix24 Point1(const Vector3& y) const { return OfConfiguration(configuration_.p_1_second, y); }
  Matrix24 Point2(const Vector3& y) const { return OfConfiguration(configuration_.p_2_second, y); }
  Matrix24 NormalRate(const Vector3& y) const { return OfRate(normal_, y); }
  Matrix24 PointRate1(const Vector3& y) const { return OfRate(point_1_, y); }
  Matrix24 PointRate2(const Vector3& y) const { return OfRate(point_2_, y); }
  Matrix24 Slip(const Vector3& y) const;
  Matrix24 Drift(const Vector3& y) const;
  Matrix24 Gap() const;
  Matrix24 GapRate() const;
  Matrix24 GapAcceleration() const;

 private:
  // A quantity X(ζ) with the rate X_ζ ξ: ∂X/∂ζ, ∂²X/∂ζ², and ∂²(X_ζ ξ)/∂ζ² at constant ξ.
  struct Rate {
    Matrix3x12 first;
    std::array<Matrix12, 3> second, rate_second;
  };

  template <typename MakeExpansion>
  void Complete(bool on_plane, const FrameMotion& body_1, const FrameMotion& body_2, const MakeExpansion& expand);
  static Matrix3x24 Joined(const Matrix3x12& by_pose, const Matrix3x12& by_twist);
  static Matrix3x24 Wide(const Matrix3x12& by_pose) { return Joined(by_pose, Matrix3x12::Zero()); }
  static Matrix24 OfConfiguration(const std::array<Matrix12, 3>& second, const Vector3& y);
  static Matrix24 OfRate(const Rate& rate, const Vector3& y);
  const Rate& Arm2() const { return on_plane_ ? point_1_ : point_2_; }
  Matrix12 Turning(const Vector3& y) const;

  bool exist_ = false, on_plane_ = false;
  FrameMotion one_, two_;
  PairKinematics kinematics_;
  PairDerivatives configuration_;
  PairRateDerivatives rates_;
  SlipDerivatives slip_;
  Rate normal_, point_1_, point_2_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_PAIR_HESSIANS_H_
