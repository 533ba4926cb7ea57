#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/verdict_audit/interval_motion.h"
#include "bench/verdict_audit/kinematics.h"
#include "bench/verdict_audit/measures.h"
#include "bench/verdict_audit/overlap.h"
#include "bench/verdict_audit/second_judge.h"

namespace rollgait::audit {
namespace {

void MeasureLimits(const Model& model, const VectorX& q, const VectorX& v, const VectorX& efforts, Measures* measures) {
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    measures->Raise(Criterion::kJointRange, std::max(q[i] - joint.position_max, joint.position_min - q[i]));
    measures->Raise(Criterion::kJointVelocity, std::abs(v[i]) / joint.velocity_max - 1);
  }
  for (size_t a = 0; a < model.actuated().size(); ++a) {
    const Joint& joint = model.joint(model.actuated()[a]);
    const double effort = efforts[static_cast<Eigen::Index>(a)];
    const double larger = std::max(std::abs(joint.effort_min), std::abs(joint.effort_max));
    const auto share = [&](double excess, double limit) { return excess / (limit != 0 ? std::abs(limit) : larger); };
    measures->Raise(Criterion::kJointEffort, share(effort - joint.effort_max, joint.effort_max));
    measures->Raise(Criterion::kJointEffort, share(joint.effort_min - effort, joint.effort_min));
  }
}

void MeasureContacts(const Scene& scene, const TrajectoryPhase& phase, const std::vector<LinkPose>& poses,
                     Measures* measures) {
  for (size_t c = 0; c < scene.contacts.size(); ++c) {
    const ContactSurface& contact = scene.contacts[c];
    const LowestPoint lowest = FindLowestPoint(contact, poses);
    const bool active =
        std::find(phase.contacts.begin(), phase.contacts.end(), static_cast<int>(c)) != phase.contacts.end();
    if (!active) {
      measures->Raise(Criterion::kPenetration, -lowest.point.z());
      continue;
    }
    double slip = 0;
    for (const int direction : contact.directions) slip = std::hypot(slip, lowest.velocity[direction]);
    measures->Raise(Criterion::kGap, std::abs(lowest.point.z()));
    measures->Raise(Criterion::kSlip, slip);
  }
}

// Pull and friction of the forces that the trajectory states.
void MeasureStatedForces(const GaitSpec& spec, const TrajectoryPhase& phase, const VectorX& numbers,
                         const std::vector<LinkPose>& poses, Measures* measures) {
  std::vector<Vector3> points, forces;
  for (size_t i = 0; i < phase.contacts.size(); ++i) {
    points.push_back(FindLowestPoint(spec.scene.contacts[static_cast<size_t>(phase.contacts[i])], poses).point);
    forces.push_back(numbers.segment<3>(static_cast<Eigen::Index>(3 * i)));
  }
  MeasureForces(spec, phase.contacts, points, forces, measures);
}

// The pairs of bodies of a scene, followed from instant to instant.
class PairMeasures {
 public:
  explicit PairMeasures(const Scene& scene) : scene_(scene), directions_(scene.pairs.size(), Vector3::UnitY()) {}

  void Measure(const std::vector<LinkPose>& poses, Measures* measures) {
    for (size_t i = 0; i < scene_.pairs.size(); ++i) {
      const WorldBody first = Place(scene_.pairs[i].first, poses), second = Place(scene_.pairs[i].second, poses);
      measures->Raise(Criterion::kOverlap, Overlap(first, second, &directions_[i]));
    }
  }

 private:
  WorldBody Place(int body, const std::vector<LinkPose>& poses) const {
    const BodySurface& surface = scene_.bodies[static_cast<size_t>(body)];
    const LinkPose& pose = poses[static_cast<size_t>(surface.joint)];
    return {pose.p_WL + pose.R_WL * surface.placed.p_BE, pose.R_WL * surface.placed.R_BE,
            BodyOf(surface.placed.surface)};
  }

  const Scene& scene_;
  std::vector<Vector3> directions_;
};

}  // namespace

void MeasurePath(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures) {
  PairMeasures pairs(spec.scene);
  for (const TrajectoryPhase& phase : trajectory.phases) {
    for (size_t k = 0; k + 1 < phase.node_times.size(); ++k) {
      const IntervalMotion interval(trajectory, phase, static_cast<int>(k));
      for (int i = 0; i <= kInstants; ++i) {
        const double theta = static_cast<double>(i) / kInstants;
        const VectorX q = interval.Position(theta), v = interval.Velocity(theta);
        const std::vector<LinkPose> poses = Poses(spec.scene.model, q, v);
        MeasureLimits(spec.scene.model, q, v, interval.Efforts(theta), measures);
        MeasureContacts(spec.scene, phase, poses, measures);
        MeasureStatedForces(spec, phase, interval.Forces(theta), poses, measures);
        pairs.Measure(poses, measures);
      }
    }
  }
}

}  // namespace rollgait::audit
