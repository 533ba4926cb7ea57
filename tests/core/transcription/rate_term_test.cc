// Rate costs against sums over the forces of the trajectory that is handed out, which knows nothing of links and
// unknowns.
#include "core/transcription/rate_term.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

using Forces = std::map<std::pair<int, int>, double>;  // (contact, axis) -> N; along x (−1 − link, 0)

// One instant's forces, in the mirror image if asked for.
Forces ForcesAt(const Scene& scene, const TrajectoryPhase& phase, int point, bool mirrored) {
  Forces forces;
  for (size_t i = 0; i < phase.contacts.size(); ++i) {
    const int own = phase.contacts[i], contact = mirrored ? scene.contacts[own].mirror_contact : own;
    const Vector3 force = phase.point_forces.col(point).segment<3>(3 * static_cast<int>(i));
    forces[{-1 - scene.contacts[contact].joint, 0}] += force.x();
    forces[{contact, 1}] = mirrored ? -force.y() : force.y();
    forces[{contact, 2}] = force.z();
  }
  return forces;
}

double SquaredChange(const Forces& from, Forces to) {
  for (const auto& [component, force] : from) to[component] -= force;
  double sum = 0;
  for (const auto& [component, change] : to) sum += change * change;
  return sum;
}

class ForceRateTest : public ::testing::TestWithParam<const char*> {};

TEST_P(ForceRateTest, IsTheSumOverTheTrajectory) {
  GaitRequest request;
  request.body.model = GetParam();
  request.body.feet = FootShape::kTwoEllipsoids;
  request.costs.push_back({cost::SquaredForceRate{}, 1.0});
  const GaitSpec spec = CheckRequest(request).value();
  const auto problem = BuildProblem(spec);
  CollocationNlp nlp(*problem, Scheme::kRadau2, Mesh::Uniform({1, 2, 2, 1}));
  VectorX x = nlp.MakeStart(WalkingGuess(spec, *problem));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  for (int k = 0; k < nlp.layout().intervals(); ++k) {
    for (int i = 0; i < 2; ++i) {
      const int first = nlp.layout().forces(k, i),
                end = nlp.layout().efforts(k, i) + nlp.layout().controls(nlp.layout().phase(k));
      for (int u = first; u < end; ++u) x(u) += noise(random);
    }
  }
  const Trajectory trajectory = nlp.Extract(x.data());
  double sum = 0, last_time = 0;
  Forces last;
  bool first = true;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    for (int i = 0; i < phase.point_forces.cols(); ++i) {
      const Forces now = ForcesAt(spec.scene, phase, i, false);
      if (!first) sum += SquaredChange(last, now) / (phase.point_times[i] - last_time);
      first = false;
      last = now;
      last_time = phase.point_times[i];
    }
  }
  // The last point is the end; the mirrored first one follows.
  sum += SquaredChange(last, ForcesAt(spec.scene, trajectory.phases[0], 0, true)) / trajectory.phases[0].point_times[0];
  EXPECT_GT(sum, 1e5);
  EXPECT_NEAR(nlp.CostIntegrals(x.data())(0), sum, 1e-11 * sum);
}

INSTANTIATE_TEST_SUITE_P(Models, ForceRateTest, ::testing::Values("planar", "human29"));

}  // namespace
}  // namespace rollgait
