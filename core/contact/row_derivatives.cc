#include "core/contact/row_derivatives.h"

#include <Eigen/Geometry>
#include <variant>

#include "core/base/check.h"
#include "core/multibody/spatial.h"

namespace rollgait {
namespace {

// First changes of the quantities that the rows are made of, along twelve directions.
struct Changes {
  Matrix3x12 normal = Matrix3x12::Zero(), normal_dot = Matrix3x12::Zero(), tangent = Matrix3x12::Zero();
  Matrix3x12 slip = Matrix3x12::Zero(), slip_dot = Matrix3x12::Zero();  // ẇ with complete accelerations
  Matrix3x12 omega = Matrix3x12::Zero(), omega_2 = Matrix3x12::Zero();  // of body 1 relative to 2, of body 2
  Matrix3x12 alpha = Matrix3x12::Zero();                                // of body 1 relative to 2
  RowVector12 gap = RowVector12::Zero();
};

class RowLinearisation {
 public:
  RowLinearisation(const TreeContact& contact, const PairKinematics& pair, const FrameMotion& body_1,
                   const FrameMotion& body_2, const Baumgarte& baumgarte)
      : contact_(contact),
        pair_(pair),
        one_(body_1),
        two_(body_2),
        baumgarte_(baumgarte),
        on_plane_(std::holds_alternative<PlacedPlane>(contact.other)) {
    const Vector3& p_2 = on_plane_ ? pair.p_1 : pair.p_2;
    const Vector3& p_dot_2 = on_plane_ ? pair.p_dot_1 : pair.p_dot_2;
    slip_dot_ = one_.a_WB + one_.alpha_WB.cross(pair.p_1 - one_.p_WB) + one_.w_WB.cross(pair.p_dot_1 - one_.v_WB) -
                two_.a_WB - two_.alpha_WB.cross(p_2 - two_.p_WB) - two_.w_WB.cross(p_dot_2 - two_.v_WB);
    along_ = two_.R_WB * contact.along;
    tangent_ = (along_ - pair.normal * pair.normal.dot(along_)).normalized();
  }

  PairRateDerivatives Rates(const Separation* separation) const {
    if (on_plane_) {
      return ComputePlaneRateDerivatives(contact_.surface, one_, std::get<PlacedPlane>(contact_.other), two_);
    }
    ROLLGAIT_CHECK(separation != nullptr);
    return ComputeSurfacePairRateDerivatives(contact_.surface, one_, std::get<PlacedSurface>(contact_.other), two_,
                                             *separation);
  }

  SlipDerivatives Slip(const PairRateDerivatives& rates) const {
    return ComputeSlipDerivatives(on_plane_, pair_, one_, two_, rates);
  }

  Changes ByPose(const PairRateDerivatives& rates, const SlipDerivatives& slip) const {
    Changes changes;
    changes.normal = rates.first.normal;
    changes.normal_dot = rates.normal_dot;
    changes.gap = rates.first.gap;
    changes.slip = slip.slip_by_pose;
    changes.slip_dot = slip.drift_by_pose;
    const Vector3& n = pair_.normal;
    Matrix3x12 turned = Matrix3x12::Zero();
    turned.rightCols<3>() = -Skew(along_);
    turned -= changes.normal * n.dot(along_) + n * (along_.transpose() * changes.normal + n.transpose() * turned);
    const double length = (along_ - n * n.dot(along_)).norm();
    changes.tangent = (turned - tangent_ * (tangent_.transpose() * turned)) / length;
    return changes;
  }

  Changes ByTwist(const PairRateDerivatives& rates, const SlipDerivatives& slip) const {
    Changes changes;
    changes.normal_dot = rates.first.normal;
    changes.slip = slip.slip_by_twist;
    changes.slip_dot = slip.drift_by_twist;
    changes.omega.middleCols<3>(3).setIdentity();
    changes.omega.rightCols<3>() = -Matrix3::Identity();
    changes.omega_2.rightCols<3>().setIdentity();
    return changes;
  }

  Changes ByAcceleration(const SlipDerivatives& slip) const {
    Changes changes;
    changes.slip_dot = slip.slip_by_twist;
    changes.alpha.middleCols<3>(3).setIdentity();
    changes.alpha.rightCols<3>() = -Matrix3::Identity();
    return changes;
  }

  // The rows of ContactDynamics::AccelerationRows as J v̇ − r:
  //   rolling       ẇ + κ w + n (ṅ·w + (2ζΩ − κ) φ̇ + Ω² φ)
  //   along t       t·(ẇ + κ w) + (ω₂ × t)·w
  //   normal        n·ẇ + ṅ·w + 2ζΩ φ̇ + Ω² φ
  //   spin          n·α + ṅ·ω + κ n·ω
  RowDerivatives::Rows Rows(const Changes& c) const {
    const Vector3 &n = pair_.normal, &w = pair_.slip;
    const double kappa = baumgarte_.slip_rate, damping = 2 * baumgarte_.damping * baumgarte_.frequency;
    const double stiffness = baumgarte_.frequency * baumgarte_.frequency;
    const RowVector12 gap_rate = n.transpose() * c.slip + w.transpose() * c.normal;
    const RowVector12 carried =
        w.transpose() * c.normal_dot + pair_.normal_dot.transpose() * c.slip + stiffness * c.gap;
    RowDerivatives::Rows rows(RowCount(contact_), 12);
    int row = 0;
    if (contact_.grip == Grip::kRolling) {
      const double along_normal = pair_.normal_dot.dot(w) + (damping - kappa) * pair_.gap_rate + stiffness * pair_.gap;
      rows.topRows<3>() =
          c.slip_dot + kappa * c.slip + n * (carried + (damping - kappa) * gap_rate) + along_normal * c.normal;
      row = 3;
    } else {
      if (contact_.grip == Grip::kRollingAlong) {
        const Vector3 turning = two_.w_WB.cross(tangent_);
        // (ω₂ × δt)·w = (w × ω₂)·δt and (δω₂ × t)·w = (t × w)·δω₂
        rows.row(row++) = tangent_.transpose() * (c.slip_dot + kappa * c.slip) + turning.transpose() * c.slip +
                          (slip_dot_ + kappa * w + w.cross(two_.w_WB)).transpose() * c.tangent +
                          tangent_.cross(w).transpose() * c.omega_2;
      }
      rows.row(row++) = n.transpose() * c.slip_dot + slip_dot_.transpose() * c.normal + carried + damping * gap_rate;
    }
    if (contact_.no_spin) {
      const Vector3 omega = one_.w_WB - two_.w_WB, alpha = one_.alpha_WB - two_.alpha_WB;
      rows.row(row++) = n.transpose() * (c.alpha + kappa * c.omega) + (alpha + kappa * omega).transpose() * c.normal +
                        pair_.normal_dot.transpose() * c.omega + omega.transpose() * c.normal_dot;
    }
    ROLLGAIT_CHECK(row == rows.rows());
    return rows;
  }

  void Wrenches(const Changes& pose, const PairRateDerivatives& rates, const Eigen::Ref<const VectorX>& forces,
                RowDerivatives* result) const {
    Vector3 force = Vector3::Zero(), couple = Vector3::Zero();
    Matrix3x12 d_force = Matrix3x12::Zero(), d_couple = Matrix3x12::Zero();
    int row = 0;
    if (contact_.grip == Grip::kRolling) {
      force = forces.head<3>();
      row = 3;
    } else {
      if (contact_.grip == Grip::kRollingAlong) {
        force += forces[row] * tangent_;
        d_force += forces[row++] * pose.tangent;
      }
      force += forces[row] * pair_.normal;
      d_force += forces[row++] * pose.normal;
    }
    if (contact_.no_spin) {
      couple = forces[row] * pair_.normal;
      d_couple = forces[row] * pose.normal;
    }
    const Vector3& p_2 = on_plane_ ? pair_.p_1 : pair_.p_2;
    const Matrix3x12& d_p_2 = on_plane_ ? rates.first.p_1 : rates.first.p_2;
    result->wrenches << pair_.p_1.cross(force) + couple, force, -p_2.cross(force) - couple, -force;
    result->wrenches_by_pose.middleRows<3>(0) = Skew(pair_.p_1) * d_force - Skew(force) * rates.first.p_1 + d_couple;
    result->wrenches_by_pose.middleRows<3>(3) = d_force;
    result->wrenches_by_pose.middleRows<3>(6) = Skew(force) * d_p_2 - Skew(p_2) * d_force - d_couple;
    result->wrenches_by_pose.middleRows<3>(9) = -d_force;
  }

 private:
  const TreeContact& contact_;
  const PairKinematics& pair_;
  const FrameMotion &one_, &two_;
  const Baumgarte& baumgarte_;
  const bool on_plane_;
  Vector3 slip_dot_, along_, tangent_;
};

}  // namespace

RowDerivatives ComputeRowDerivatives(const TreeContact& contact, const PairKinematics& kinematics,
                                     const Separation* separation, const FrameMotion& body_1, const FrameMotion& body_2,
                                     const Baumgarte& baumgarte, const Eigen::Ref<const VectorX>& forces) {
  const RowLinearisation linearisation(contact, kinematics, body_1, body_2, baumgarte);
  const PairRateDerivatives rates = linearisation.Rates(separation);
  const SlipDerivatives slip = linearisation.Slip(rates);
  const Changes pose = linearisation.ByPose(rates, slip);
  RowDerivatives result;
  result.exist = rates.first.order == 2;
  result.by_pose = linearisation.Rows(pose);
  result.by_twist = linearisation.Rows(linearisation.ByTwist(rates, slip));
  result.by_acceleration = linearisation.Rows(linearisation.ByAcceleration(slip));
  linearisation.Wrenches(pose, rates, forces, &result);
  return result;
}

}  // namespace rollgait
