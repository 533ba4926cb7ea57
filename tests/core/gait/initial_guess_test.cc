#include "core/gait/initial_guess.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/contact/pair_separation.h"
#include "core/gait/build_problem.h"
#include "core/multibody/body_dynamics.h"

namespace rollgait {
namespace {

struct Case {
  const char* model;
  FootShape feet;
  Cycle cycle;
};

class WalkingGuessTest : public ::testing::TestWithParam<Case> {
 protected:
  WalkingGuessTest() {
    GaitRequest request;
    request.body.model = GetParam().model;
    request.body.feet = GetParam().feet;
    request.cycle = GetParam().cycle;
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
  }
  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
};

// A step in the position where contacts change is an acceleration of a step over the square of an interval: 1 cm in 20
// ms is 25 m/s². Solves that started so ended in restorations.
TEST_P(WalkingGuessTest, PositionsAreContinuousThroughThePhases) {
  for (const int variant : {0, 1, 2}) {
    const MotionGuess guess = WalkingGuess(*spec_, *problem_, variant);
    const int phases = static_cast<int>(problem_->phases.size());
    for (int p = 0; p + 1 < phases; ++p) {
      const VectorX step = guess.motion(p + 1, 0).position - guess.motion(p, 1).position;
      EXPECT_LT(step.cwiseAbs().maxCoeff(), 1e-12) << "phase " << p;
    }
    // The end is the start, mirrored in a half cycle, and moved on. Legs alone know left from right here.
    const VectorX start = guess.motion(0, 0).position, end = guess.motion(phases - 1, 1).position;
    for (int j = 0; j < problem_->model.size(); ++j) {
      const Joint& joint = problem_->model.joint(j);
      const int source = problem_->mirrored && joint.mirror_joint >= 0 ? joint.mirror_joint : j;
      const double moved = j == problem_->forward_joint ? guess.displacement : 0;
      EXPECT_NEAR(end(j), start(source) + moved, 1e-12) << joint.name;
    }
  }
}

// Who starts with legs through each other may come out on the wrong side.
TEST_P(WalkingGuessTest, LimbsPassBesideEachOther) {
  const BodyDynamics dynamics(problem_->model);
  BodyDynamics::State state;
  const auto pose = [&](const BodySurface& body) -> PosedSurface {
    const BodyDynamics::Link& link = state[body.joint];
    return {&body.placed.surface, link.R_WL * body.placed.R_BE, link.p_WL + link.R_WL * body.placed.p_BE};
  };
  for (const int variant : {0, 1, 2}) {
    const MotionGuess guess = WalkingGuess(*spec_, *problem_, variant);
    for (int p = 0; p < static_cast<int>(problem_->phases.size()); ++p) {
      for (int i = 0; i <= 20; ++i) {
        const VectorX q = guess.motion(p, 0.05 * i).position;
        dynamics.ComputeState(q, VectorX::Zero(q.size()), &state);
        for (size_t pair = 0; pair < problem_->pairs.size(); ++pair) {
          const BodySurface &first = problem_->bodies[problem_->pairs[pair].first],
                            &second = problem_->bodies[problem_->pairs[pair].second];
          EXPECT_GT(FindSeparation(pose(first), pose(second), nullptr).distance, 1e-3)
              << first.name << " " << second.name;
        }
      }
    }
  }
  EXPECT_EQ(problem_->pairs.empty(), GetParam().model == std::string("planar"));
}

// A force that starts on its bound cuts the first steps short.
TEST_P(WalkingGuessTest, EveryContactCarriesAndTogetherTheyCarryTheWeight) {
  const MotionGuess guess = WalkingGuess(*spec_, *problem_);
  for (int p = 0; p < static_cast<int>(problem_->phases.size()); ++p) {
    for (const double fraction : {0.0, 0.5, 1.0}) {
      const VectorX forces = guess.motion(p, fraction).forces;
      double sum = 0;
      for (int row = 2; row < forces.size(); row += 3) {
        EXPECT_GT(forces(row), 0.05 * problem_->force_size());
        sum += forces(row);
      }
      EXPECT_NEAR(sum, problem_->force_size(), 1e-9);
    }
  }
}

// The same body with joints of other names, half of which turn the other way.
std::vector<Joint> RenamedAndTurned(const std::vector<Joint>& joints) {
  std::vector<Joint> others = joints;
  for (size_t j = 0; j < others.size(); ++j) {
    Joint& joint = others[j];
    joint.name = "j" + std::to_string(j);
    if (joint.type != JointType::kRevolute || j % 2 == 0) continue;
    joint.axis = -joint.axis;
    joint.position_min = -joints[j].position_max;
    joint.position_max = -joints[j].position_min;
    joint.mirror_joint = static_cast<int>(j);  // its image may turn the first way; the guess does not ask
  }
  for (size_t j = 0; j < others.size(); ++j) {
    if (others[others[j].mirror_joint].mirror_joint != static_cast<int>(j))
      others[j].mirror_joint = static_cast<int>(j);
  }
  return others;
}

TEST_P(WalkingGuessTest, NeedsRolesAndNoNames) {
  const MotionGuess guess = WalkingGuess(*spec_, *problem_, 1);
  const int phases = static_cast<int>(problem_->phases.size());
  std::vector<VectorX> positions;  // now: the motion refers to the problem, which changes
  for (int p = 0; p < phases; ++p) positions.push_back(guess.motion(p, 0.4).position);
  const std::vector<Joint> joints = spec_->scene.model.joints();
  spec_->scene.model = Model::Create(RenamedAndTurned(joints)).value();
  problem_->model = spec_->scene.model;
  const MotionGuess other = WalkingGuess(*spec_, *problem_, 1);
  ASSERT_EQ(other.durations, guess.durations);
  int turned = 0;
  for (int p = 0; p < phases; ++p) {
    const VectorX &q = positions[p], q_other = other.motion(p, 0.4).position;
    for (int j = 0; j < q.size(); ++j) {
      const double sign = problem_->model.joint(j).axis == joints[j].axis ? 1 : -1;
      turned += sign < 0 && q(j) != 0;
      EXPECT_NEAR(q_other(j), sign * q(j), 1e-15) << joints[j].name;
    }
  }
  EXPECT_GT(turned, 0);
  // Without roles nothing moves but the base.
  std::vector<Joint> plain = joints;
  for (Joint& joint : plain) {
    if (joint.side != BodySide::kMidline) joint.role = JointRole::kNone;
  }
  problem_->model = Model::Create(std::move(plain)).value();
  const VectorX still = WalkingGuess(*spec_, *problem_).motion(0, 0.4).position;
  for (int j = 0; j < still.size(); ++j) {
    if (joints[j].side == BodySide::kMidline) continue;
    EXPECT_EQ(still(j), 0) << joints[j].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, WalkingGuessTest,
                         ::testing::Values(Case{"planar", FootShape::kOneEllipsoid, Cycle::kHalf},
                                           Case{"planar", FootShape::kTwoEllipsoids, Cycle::kFull},
                                           Case{"human29", FootShape::kTwoEllipsoids, Cycle::kHalf}));

}  // namespace
}  // namespace rollgait
