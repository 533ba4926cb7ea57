#include "core/contact/contact_sensitivity.h"

#include <algorithm>
#include <iterator>

#include "core/base/check.h"

namespace rollgait {

ContactSensitivitySolver::ContactSensitivitySolver(const Model& model, ContactDynamics* dynamics)
    : dynamics_(*dynamics), motion_(model) {}

// Of a link or of the ground, accelerations complete.
FrameMotion ContactSensitivitySolver::Frame(int link, int ground) const {
  if (link < 0) return dynamics_.ground(ground);
  const BodyDynamics::Link& body = dynamics_.state()[static_cast<size_t>(link)];
  const MotionDerivatives::PointMotion origin = motion_.Origin(link);
  return {body.R_WL, body.p_WL, origin.w, origin.v, origin.alpha, origin.a};
}

const ContactSensitivity& ContactSensitivitySolver::Solve(const std::vector<int>& active, const VectorX& tau,
                                                          const Vector3& gravity, const Baumgarte& baumgarte) {
  ROLLGAIT_CHECK(!dynamics_.AnySlides(active));
  const ConstrainedSolution& solution = dynamics_.Accelerate(active, tau, gravity, baumgarte);
  const int nv = static_cast<int>(tau.size()), rows = static_cast<int>(solution.forces.size());
  result_.redundant = solution.redundant;
  result_.exists = true;
  motion_.Update(dynamics_.state(), dynamics_.velocity(), solution.acceleration, gravity);
  const int width = (3 * nv + 3) / 4 * 4;
  dynamics_by_.resize(nv, width);
  rows_by_.resize(rows, width);
  for (int i = 0; i < nv; ++i) dynamics_by_.row(i).setZero();  // row by row: a long memset is slow to begin
  for (int i = 0; i < rows; ++i) rows_by_.row(i).setZero();
  motion_.InverseDynamics(dynamics_by_.leftCols(nv), dynamics_by_.middleCols(nv, nv));
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
  const int links[2] = {contact.link, contact.other_link};
  moving_.clear();
  static const std::vector<int> kNone;
  const std::vector<int>* paths[2] = {&motion_.path(links[0]), links[1] < 0 ? &kNone : &motion_.path(links[1])};
  std::set_union(paths[0]->begin(), paths[0]->end(), paths[1]->begin(), paths[1]->end(), std::back_inserter(moving_));
  const int count = static_cast<int>(derivatives.by_pose.rows());
  for (int m : moving_) {
    Vector12 pose = Vector12::Zero(), twist_q = pose, twist_v = pose, acceleration_q = pose, acceleration_v = pose;
    for (int side = 0; side < 2; ++side) {
      if (!std::binary_search(paths[side]->begin(), paths[side]->end(), m)) continue;
      const MotionDerivatives::Change by_q = motion_.AlongPosition(links[side], m);
      const MotionDerivatives::Change by_v = motion_.AlongVelocity(links[side], m);
      pose.segment<6>(6 * side) << by_q.shift, by_q.turn;
      twist_q.segment<6>(6 * side) << by_q.motion.v, by_q.motion.w;
      twist_v.segment<6>(6 * side) << by_v.motion.v, by_v.motion.w;
      acceleration_q.segment<6>(6 * side) << by_q.motion.a, by_q.motion.alpha;
      acceleration_v.segment<6>(6 * side) << by_v.motion.a, by_v.motion.alpha;
    }
    rows_by_.col(m).segment(row, count).noalias() = derivatives.by_pose * pose + derivatives.by_twist * twist_q +
                                                   derivatives.by_acceleration * acceleration_q;
    rows_by_.col(nv + m).segment(row, count).noalias() =
        derivatives.by_twist * twist_v + derivatives.by_acceleration * acceleration_v;
    // The generalised force S_k · W of a wrench W: W changes, and S_k turns with whatever moves it.
    const Vector12 change = derivatives.wrenches_by_pose * pose;
    for (int side = 0; side < 2; ++side) {
      const Vector6 moved = change.segment<6>(6 * side), wrench = derivatives.wrenches.segment<6>(6 * side);
      const Vector6 turned = -CrossForce(motion_.column(m), wrench);  // (S_m × S_k) · W = −S_k · (S_m ×* W)
      for (int k : *paths[side]) {
        dynamics_by_(k, m) -= motion_.column(k).dot(motion_.Moves(m, k) ? Vector6(moved + turned) : moved);
      }
    }
  }
}

}  // namespace rollgait
