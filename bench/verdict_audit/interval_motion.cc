#include "bench/verdict_audit/interval_motion.h"

#include <Eigen/LU>
#include <cmath>

namespace rollgait::audit {
namespace {

VectorX Powers(double theta, Eigen::Index count) {
  VectorX powers(count);
  for (Eigen::Index i = 0; i < count; ++i) powers[i] = std::pow(theta, static_cast<double>(i));
  return powers;
}

}  // namespace

IntervalMotion::IntervalMotion(const Trajectory& trajectory, const TrajectoryPhase& phase, int interval)
    : start_(phase.node_times[static_cast<size_t>(interval)]),
      length_(phase.node_times[static_cast<size_t>(interval) + 1] - start_),
      position_(phase.node_positions.col(interval)),
      velocity_(phase.node_velocities.col(interval)) {
  const int s = trajectory.points_per_interval;
  MatrixX powers(s, s);  // the powers of each point, a column each
  for (int i = 0; i < s; ++i) powers.col(i) = Powers(trajectory.point_fractions[static_cast<size_t>(i)], s);
  const MatrixX inverse = powers.inverse();
  acceleration_ = phase.point_accelerations.middleCols(interval * s, s) * inverse;
  efforts_ = phase.point_efforts.middleCols(interval * s, s) * inverse;
  forces_ = phase.point_forces.middleCols(interval * s, s) * inverse;
}

VectorX IntervalMotion::Velocity(double theta) const {
  VectorX integral = Powers(theta, acceleration_.cols());
  for (Eigen::Index i = 0; i < integral.size(); ++i) integral[i] *= theta / static_cast<double>(i + 1);
  return velocity_ + length_ * (acceleration_ * integral);
}

VectorX IntervalMotion::Position(double theta) const {
  VectorX integral = Powers(theta, acceleration_.cols());
  for (Eigen::Index i = 0; i < integral.size(); ++i)
    integral[i] *= theta * theta / static_cast<double>((i + 1) * (i + 2));
  return position_ + length_ * theta * velocity_ + length_ * length_ * (acceleration_ * integral);
}

VectorX IntervalMotion::Efforts(double theta) const { return efforts_ * Powers(theta, efforts_.cols()); }
VectorX IntervalMotion::Forces(double theta) const { return forces_ * Powers(theta, forces_.cols()); }

}  // namespace rollgait::audit
