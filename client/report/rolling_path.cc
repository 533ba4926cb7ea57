#include "client/report/rolling_path.h"

#include <Eigen/LU>

#include "client/failure.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

constexpr int kSamples = 201;
constexpr int kFirstAngle = 3, kJoints = 6;

void RequireRollingBody(const v1::Model& model) {
  bool good = model.joints_size() == kJoints && model.contacts_size() == 1;
  for (int i = 0; good && i < kJoints; ++i) {
    good = model.joints(i).parent() == i - 1 && model.joints(i).actuated() == (i >= kFirstAngle);
  }
  if (!good) {
    throw Failure(ExitCode::kUsage, "model " + model.summary().name() +
                                        " is no rolling body: three slides, three actuated angles and one contact");
  }
}

}  // namespace

RollingPath BuildRollingPath(const v1::Trajectory& trajectory, const v1::Model& model) {
  RequireRollingBody(model);
  const Motion motion(trajectory, model);
  RollingPath path;
  path.duration_s = motion.duration_s();
  for (int k = 0; k < kSamples; ++k) {
    const Instant at = motion.At(path.duration_s * k / (kSamples - 1), k == kSamples - 1);
    const std::vector<Pose> poses = LinkPoses(model, at.position);
    // By virtual power the efforts are Aᵀ M, the columns of A the axes of the joints.
    Eigen::Matrix3d axes;
    Eigen::Vector3d efforts;
    for (int i = 0; i < 3; ++i) {
      axes.col(i) = poses[kFirstAngle + i].rotation * ToVector(model.joints(kFirstAngle + i).axis());
      efforts(i) = at.effort[kFirstAngle + i];
    }
    const Eigen::Vector3d& center = poses.back().position;
    const Eigen::Vector3d lowest = LowestPoint(model.contacts(0), poses);
    path.samples.push_back(
        {lowest.x(), lowest.y(), center.x(), center.y(), (axes.transpose().inverse() * efforts).norm()});
    path.instants.push_back(at);
  }
  return path;
}

}  // namespace rollgait::client
