// Every bound of the transcription that no other test looks at, by what it means: of unknowns, and of the rows that are
// linear in them.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

class BoundsTest : public ::testing::Test {
 protected:
  void Build(const GaitRequest& request, const std::function<void(OptimalControlProblem*)>& change = {}) {
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    if (change) change(problem_.get());
    nlp_ = std::make_unique<CollocationNlp>(*problem_, Scheme::kRadau2,
                                            Mesh::Uniform(std::vector<int>(problem_->phases.size(), 2)));
    x_ = VectorX::Zero(nlp_->variables());
    for (int p = 0; p < layout().phases(); ++p) x_(layout().duration(p)) = 0.3;
  }
  static GaitRequest Walk(const char* model) {
    GaitRequest request;
    request.body.model = model;
    request.motion.speed = 1.3;
    return request;
  }
  const DecisionLayout& layout() const { return nlp_->layout(); }

  struct Row {
    double value, lower, upper;  // in the row's unit
  };
  // The only rows with this name, at x_.
  std::vector<Row> Named(const std::string& name) {
    VectorX g(nlp_->constraints());
    EXPECT_TRUE(nlp_->Constraints(x_.data(), g.data()));
    std::vector<Row> rows;
    for (int r = 0; r < nlp_->constraints(); ++r) {
      const RowInfo info = nlp_->Describe(x_.data(), r);
      if (info.name != name) continue;
      rows.push_back(
          {g(r) * info.size, nlp_->constraint_lower()(r) * info.size, nlp_->constraint_upper()(r) * info.size});
    }
    return rows;
  }
  // Whether the rows with this name allow x_.
  bool Allows(const std::string& name) {
    const std::vector<Row> rows = Named(name);
    EXPECT_FALSE(rows.empty()) << name;
    for (const Row& row : rows) {
      if (row.value < row.lower - 1e-9 || row.value > row.upper + 1e-9) return false;
    }
    return true;
  }
  void SetDurations(const std::vector<double>& durations) {
    ASSERT_EQ(static_cast<int>(durations.size()), layout().phases());
    for (int p = 0; p < layout().phases(); ++p) x_(layout().duration(p)) = durations[p];
  }

  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_;
};

TEST_F(BoundsTest, DurationsAndDisplacement) {
  Build(Walk("planar"), [](OptimalControlProblem* problem) {
    problem->phases[0].duration = {0.2, 0.9};
    problem->phases[1].duration = {0.03, 0.4};
    problem->displacement = {0.5, 0.8};
  });
  const auto expect = [&](int unknown, double lower, double upper) {
    EXPECT_EQ(nlp_->lower_bounds()(unknown), lower);
    EXPECT_EQ(nlp_->upper_bounds()(unknown), upper);
  };
  expect(layout().duration(0), 0.2, 0.9);
  expect(layout().duration(1), 0.03, 0.4);
  expect(layout().displacement(), 0.5, 0.8);
  expect(layout().node(0) + problem_->forward_joint, 0, 0);
}

TEST_F(BoundsTest, SpeedIsDisplacementOverDuration) {
  const auto allows = [&](double displacement) {
    SetDurations({0.3, 0.2});
    x_(layout().displacement()) = displacement;
    return Allows("speed");
  };
  Build(Walk("planar"), [](OptimalControlProblem* problem) { problem->speed = {1.2, 1.2}; });
  EXPECT_TRUE(allows(0.6));
  EXPECT_FALSE(allows(0.61));
  EXPECT_FALSE(allows(0.59));
  Build(Walk("planar"), [](OptimalControlProblem* problem) { problem->speed = {1.1, 1.3}; });
  EXPECT_TRUE(allows(0.6));
  EXPECT_FALSE(allows(0.66));
  EXPECT_FALSE(allows(0.54));
}

// A foot stands through the support of both and half of the support of one.
TEST_F(BoundsTest, DutyFactorIsTheShareOfStance) {
  const auto allows = [&](double single, double both) {
    for (int p = 0; p < layout().phases(); ++p) {
      x_(layout().duration(p)) = problem_->StandingFeet(p) == 2 ? both : single;
    }
    return Allows("duty factor");
  };
  Build(Walk("planar"), [](OptimalControlProblem* problem) { problem->duty_factor = Interval{0.6, 0.6}; });
  EXPECT_TRUE(allows(0.4, 0.1));
  EXPECT_FALSE(allows(0.41, 0.09));
  EXPECT_FALSE(allows(0.39, 0.11));
  Build(Walk("planar"), [](OptimalControlProblem* problem) { problem->duty_factor = Interval{0.58, 0.62}; });
  EXPECT_TRUE(allows(0.4, 0.1));
  EXPECT_FALSE(allows(0.43, 0.07));
  EXPECT_FALSE(allows(0.37, 0.13));
}

TEST_F(BoundsTest, AStepTakesAsLongAsItMay) {
  Build(Walk("planar"), [](OptimalControlProblem* problem) { problem->duration = {0.4, 0.6}; });
  const auto allows = [&](double single, double both) {
    SetDurations({single, both});
    return Allows("step duration");
  };
  EXPECT_TRUE(allows(0.4, 0.1));
  EXPECT_FALSE(allows(0.3, 0.09));
  EXPECT_FALSE(allows(0.5, 0.11));
}

// The end of half a cycle is the mirrored start, further on by the displacement: every joint in its position and
// velocity.
TEST_F(BoundsTest, PeriodicityMirrorsEveryJoint) {
  Build(Walk("human29"));
  ASSERT_TRUE(problem_->mirrored);
  const Model& model = problem_->model;
  const int n = model.size(), start = layout().node(0), end = layout().node(layout().intervals());
  for (int i = 0; i < 2 * n; ++i) x_(start + i) = 0.01 * (i + 1);
  x_(layout().displacement()) = 0.7;
  int turned = 0;
  for (int j = 0; j < n; ++j) {
    const Joint& joint = model.joint(j);
    const int source = joint.mirror_joint < 0 ? j : joint.mirror_joint;
    x_(end + j) = joint.mirror_sign * x_(start + source) + (j == problem_->forward_joint ? 0.7 : 0);
    x_(end + n + j) = joint.mirror_sign * x_(start + n + source);
    turned += joint.mirror_sign < 0;
  }
  EXPECT_GE(turned, 5);
  for (int j = 0; j < n; ++j) {
    const std::string name = "periodicity " + model.joint(j).name;
    EXPECT_EQ(Named(name).size(), 2u);
    EXPECT_TRUE(Allows(name)) << name;
    for (int unknown : {end + j, end + n + j}) {
      x_(unknown) += 1e-3;
      EXPECT_FALSE(Allows(name)) << name;
      x_(unknown) -= 1e-3;
    }
  }
}

// A plastic touch-down changes velocities, which have the joints' limits on both sides of it, and no position; its
// impulses push.
TEST_F(BoundsTest, TouchDownsKeepPositionsAndPush) {
  GaitRequest request = Walk("planar");
  request.cycle = Cycle::kFull;
  request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
  Build(request);
  const int n = problem_->model.size();
  int jumps = 0;
  for (int p = 0; p < layout().phases(); ++p) {
    if (!layout().jumps(p)) continue;
    ++jumps;
    for (const ActiveContact& active : problem_->ActiveContacts(p)) {
      const int normal = layout().impulse(p) + active.offset + static_cast<int>(active.directions.size()) - 1;
      EXPECT_EQ(nlp_->lower_bounds()(normal), 0);
      EXPECT_EQ(nlp_->upper_bounds()(normal), kInfinity);
      if (active.directions.size() > 1) {
        EXPECT_EQ(nlp_->lower_bounds()(normal - 1), -kInfinity);
      }
    }
    if (p == 0) continue;
    const int before = layout().end_node(layout().first_interval(p) - 1);
    for (int j = 0; j < n; ++j) {
      const Joint& joint = problem_->model.joint(j);
      EXPECT_EQ(nlp_->lower_bounds()(before + n + j), -joint.velocity_max);
      EXPECT_EQ(nlp_->upper_bounds()(before + n + j), joint.velocity_max);
      const std::string name = "position at touch-down " + joint.name;
      EXPECT_TRUE(Allows(name));
      for (int unknown : {before + j, layout().node(layout().first_interval(p)) + j}) {
        x_(unknown) = 1e-3;
        EXPECT_FALSE(Allows(name)) << name;
        x_(unknown) = 0;
      }
    }
  }
  EXPECT_EQ(jumps, 2);
}

// From one state to another: what the ends prescribe, the nodes there have as bounds, within the joints' own.
TEST_F(BoundsTest, ManoeuvresBeginAndEndWhereTheyShould) {
  Build(Walk("planar"), [](OptimalControlProblem* problem) {
    const int size = 2 * problem->model.size();
    const EndBounds free{VectorX::Constant(size, -kInfinity), VectorX::Constant(size, kInfinity)};
    problem->ends.emplace(Ends{free, free});
    problem->ends->start.lower(4) = problem->ends->start.upper(4) = 0.1;
    problem->ends->end.lower(5) = 0.2;
    problem->ends->end.upper(5) = 0.3;
    problem->ends->end.upper(size - 1) = 1e9;  // the joint's own limit is narrower
    problem->displacement = {0.6, 0.6};
  });
  const int size = 2 * problem_->model.size(), first = layout().node(0), last = layout().node(layout().intervals());
  const auto bounds = [&](int unknown) {
    return std::pair(nlp_->lower_bounds()(unknown), nlp_->upper_bounds()(unknown));
  };
  EXPECT_EQ(bounds(first + 4), std::pair(0.1, 0.1));
  EXPECT_EQ(bounds(last + 5), std::pair(0.2, 0.3));
  const double fastest = problem_->model.joint(problem_->model.size() - 1).velocity_max;
  EXPECT_EQ(bounds(last + size - 1), std::pair(-fastest, fastest));
}

// A hundredth of 1 s would be half of the shortest phase.
TEST_F(BoundsTest, DurationsAreMeasuredByTheShortest) {
  Build(Walk("planar"));
  for (int i = 0; i < nlp_->variables(); ++i) {
    const int phase = i - layout().duration(0);
    const bool is_duration = phase >= 0 && phase < layout().phases();
    EXPECT_EQ(nlp_->variable_size(i), is_duration ? problem_->phases[phase].duration.min : 1) << i;
  }
}

}  // namespace
}  // namespace rollgait
