#include "core/contact/contact_sensitivity.h"

#include <Eigen/Geometry>

#include "core/base/check.h"

namespace rollgait {
namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4x6 = Eigen::Matrix<double, 4, 6>;

Vector6 Stack(const Vector3& linear, const Vector3& angular) {
  Vector6 both;
  both << linear, angular;
  return both;
}

// A wrench about the world's origin, about another point.
Vector6 At(const Vector3& point, Vector6 wrench) {
  wrench.head<3>() -= point.cross(wrench.tail<3>());
  return wrench;
}

// What RowDerivatives says of the motion of one body, whose columns begin at `first`; missing rows are zero.
struct SideData {
  SideData(const RowDerivatives& all, int first) {
    const auto count = all.by_pose.rows();
    by_pose.topRows(count) = all.by_pose.middleCols<6>(first);
    by_twist.topRows(count) = all.by_twist.middleCols<6>(first);
    by_acceleration.topRows(count) = all.by_acceleration.middleCols<6>(first);
    for (int body = 0; body < 2; ++body) wrenches[body] = all.wrenches_by_pose.block<6, 6>(6 * body, first);
  }
  Matrix4x6 by_pose = Matrix4x6::Zero(), by_twist = Matrix4x6::Zero(), by_acceleration = Matrix4x6::Zero();
  Matrix6 wrenches[2];
};

}  // namespace

ContactSensitivitySolver::ContactSensitivitySolver(const Model& model, ContactDynamics* dynamics)
    : dynamics_(*dynamics) {
  ROLLGAIT_CHECK(model.nv() == dynamics->dynamics().nv());
}

// Of a link or of the ground, accelerations complete.
FrameMotion ContactSensitivitySolver::Frame(int link, int ground) const {
  if (link < 0) return dynamics_.ground(ground);
  const BodyDynamics::Link& body = dynamics_.state()[static_cast<size_t>(link)];
  const MotionDerivatives::PointMotion origin = motion_->Origin(link);
  return {body.R_WL, body.p_WL, origin.w, origin.v, origin.alpha, origin.a};
}

const ContactSensitivity& ContactSensitivitySolver::Solve(const std::vector<int>& active, const VectorX& tau,
                                                          const Vector3& gravity, const Baumgarte& baumgarte) {
  ROLLGAIT_CHECK(!dynamics_.AnySlides(active));
  const ConstrainedSolution& solution = dynamics_.Accelerate(active, tau, gravity, baumgarte);
  const int nv = static_cast<int>(tau.size()), rows = static_cast<int>(solution.forces.size());
  result_.redundant = solution.redundant;
  result_.exists = true;
  motion_ = &dynamics_.Motion();
  motion_->SetAcceleration(solution.acceleration, gravity);
  motion_->UpdateDerivatives();
  const int width = (3 * nv + 3) / 4 * 4;
  dynamics_by_.resize(nv, width);
  rows_by_.resize(rows, width);
  for (int i = 0; i < nv; ++i) dynamics_by_.row(i).setZero();  // row by row: a long memset is slow to begin
  for (int i = 0; i < rows; ++i) rows_by_.row(i).setZero();
  motion_->InverseDynamics(dynamics_by_.leftCols(nv), dynamics_by_.middleCols(nv, nv));
  dynamics_by_.middleCols(2 * nv, nv).diagonal().setConstant(-1);
  int row = 0;
  for (int k : active) {
    const TreeContact& contact = dynamics_.contact(k);
    const int count = RowCount(contact);
    const RowDerivatives derivatives = ComputeRowDerivatives(
        contact, dynamics_.Kinematics(k), dynamics_.separation(k), Frame(contact.link, 0),
        Frame(contact.other_link, contact.ground), baumgarte, solution.forces.segment(row, count));
    result_.exists = result_.exists && derivatives.exist;
    AddContact(contact, derivatives, row);
    row += count;
  }
  dynamics_.Differentiate(&dynamics_by_, &rows_by_);
  result_.acceleration_q = -dynamics_by_.leftCols(nv);
  result_.acceleration_v = -dynamics_by_.middleCols(nv, nv);
  result_.acceleration_tau = -dynamics_by_.middleCols(2 * nv, nv);
  result_.forces_q = -rows_by_.leftCols(nv);
  result_.forces_v = -rows_by_.middleCols(nv, nv);
  result_.forces_tau = -rows_by_.middleCols(2 * nv, nv);
  return result_;
}

void ContactSensitivitySolver::AddContact(const TreeContact& contact, const RowDerivatives& derivatives, int row) {
  const int nv = static_cast<int>(dynamics_by_.rows());
  const int count = static_cast<int>(derivatives.by_pose.rows());
  const int sides = contact.other_link < 0 ? 1 : 2, links[2] = {contact.link, contact.other_link};
  Vector6 wrenches[2];
  for (int side = 0; side < sides; ++side) {
    wrenches[side] = At(motion_->reference(links[side]), derivatives.wrenches.segment<6>(6 * side));
  }
  for (int side = 0; side < sides; ++side) {
    const SideData of(derivatives, 6 * side);
    for (int m : motion_->path(links[side])) {
      const MotionDerivatives::Change by_q = motion_->AlongPosition(links[side], m);
      const MotionDerivatives::Change by_v = motion_->AlongVelocity(links[side], m);
      const Vector6 pose = Stack(by_q.shift, by_q.turn);
      const Vector4 rows_q = of.by_pose * pose + of.by_twist * Stack(by_q.motion.v, by_q.motion.w) +
                             of.by_acceleration * Stack(by_q.motion.a, by_q.motion.alpha);
      const Vector4 rows_v = of.by_twist * Stack(by_v.motion.v, by_v.motion.w) +
                             of.by_acceleration * Stack(by_v.motion.a, by_v.motion.alpha);
      for (int i = 0; i < count; ++i) {
        rows_by_(row + i, m) += rows_q[i];
        rows_by_(row + i, nv + m) += rows_v[i];
      }
      // The generalised force S_k · W of a wrench W: W changes, and S_k turns with whatever moves it:
      // (S_m × S_k) · W = −S_k · (S_m ×* W).
      for (int acted = 0; acted < sides; ++acted) {
        const Vector6 moved = At(motion_->reference(links[acted]), of.wrenches[acted] * pose);
        Vector6 both = moved;
        if (acted == side) both -= CrossForce(motion_->column(m), wrenches[side]);
        for (int k : motion_->path(links[acted])) {
          dynamics_by_(k, m) -= motion_->column(k).dot(motion_->Moves(m, k) ? both : moved);
        }
      }
    }
  }
}

}  // namespace rollgait
