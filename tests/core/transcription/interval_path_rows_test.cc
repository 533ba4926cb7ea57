// The rows between the points are Bernstein coefficients of the curves that the trajectory states, and have the bounds
// of the problem.
#include "core/transcription/interval_path_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/trajectory/sampling.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

struct Case {
  const char* model;
  Scheme scheme;
};

class IntervalPathRowsTest : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr int kIntervals = 2;  // a phase

  void Build(Preset preset) {
    GaitRequest request;
    request.body.model = GetParam().model;
    request.body.feet = FootShape::kTwoEllipsoids;
    request.preset = preset;
    request.motion.speed = 1.3;
    request.discretization.scheme = GetParam().scheme;
    request.ground_contact.friction_coefficient = 0.7;
    request.ground_contact.min_normal_force_bw = least_force_;
    request.limits.joint_velocity["knee_r"] = 7;
    request.limits.joint_position["knee_r"] = {0.01, 1.1};
    request.limits.joint_effort["knee_r"] = {-90, 80};
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    knee_ = problem_->model.Find("knee_r");
    added_.between.assign(problem_->phases.size(), {{knee_}, {knee_}, {knee_}});
    nlp_ = std::make_unique<CollocationNlp>(
        *problem_, GetParam().scheme, Mesh::Uniform(std::vector<int>(problem_->phases.size(), kIntervals)), added_);
    x_ = nlp_->MakeStart(WalkingGuess(*spec_, *problem_));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> noise(-0.2, 0.2);
    for (int i = 0; i < nlp_->layout().duration(0); ++i) x_(i) += noise(random);
    g_.resize(nlp_->constraints());
    ASSERT_TRUE(nlp_->Constraints(x_.data(), g_.data()));
    trajectory_ = nlp_->Extract(x_.data());
  }

  // Rows of an interval with this name, in physical units: values, lower and upper bounds.
  struct Rows {
    std::vector<double> values, lower, upper;
  };
  Rows Named(const std::string& name, int phase, int interval) const {
    Rows rows;
    const TrajectoryPhase& data = trajectory_.phases[phase];
    const double begin = data.node_times[interval], end = data.node_times[interval + 1];
    for (int r = 0; r < nlp_->constraints(); ++r) {
      const RowInfo info = nlp_->Describe(x_.data(), r);
      if (info.name != name || info.phase != phase || info.time < begin + 1e-12 || info.time > end + 1e-12) continue;
      rows.values.push_back(g_(r) * info.size);
      rows.lower.push_back(nlp_->constraint_lower()(r) * info.size);
      rows.upper.push_back(nlp_->constraint_upper()(r) * info.size);
    }
    return rows;
  }

  // The coefficients `inner`, completed by the ends of the curve where rows are missing there, give the curve.
  void ExpectCurve(std::vector<double> inner, bool with_start, bool with_end,
                   const std::function<double(double)>& curve) {
    if (with_start) inner.insert(inner.begin(), curve(0));
    if (with_end) inner.push_back(curve(1));
    double size = 1;
    for (double value : inner) size = std::max(size, std::abs(value));
    for (double theta = 0; theta <= 1; theta += 0.25) {
      std::vector<double> b = inner;
      for (size_t left = b.size() - 1; left > 0; --left) {
        for (size_t i = 0; i < left; ++i) b[i] = (1 - theta) * b[i] + theta * b[i + 1];
      }
      EXPECT_NEAR(b[0], curve(theta), 1e-11 * size) << theta;
    }
  }

  bool Lobatto() const { return GetParam().scheme == Scheme::kHermiteSimpson; }

  double least_force_ = 0;
  int knee_ = 0;
  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  AddedConstraints added_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_, g_;
  Trajectory trajectory_;
};

TEST_P(IntervalPathRowsTest, AreTheBernsteinCoefficientsOfTheStatedCurves) {
  Build(Preset::kHuman);
  const std::vector<int>& actuated = problem_->model.actuated();
  const int effort = static_cast<int>(std::find(actuated.begin(), actuated.end(), knee_) - actuated.begin());
  for (int phase = 0; phase < static_cast<int>(trajectory_.phases.size()); ++phase) {
    for (int k = 0; k < kIntervals; ++k) {
      const auto at = [&](double theta) { return Sample(trajectory_, phase, k, theta); };
      ExpectCurve(Named("velocity knee_r", phase, k).values, true, true,
                  [&](double t) { return at(t).velocity[knee_]; });
      ExpectCurve(Named("range knee_r", phase, k).values, true, true, [&](double t) { return at(t).position[knee_]; });
      ExpectCurve(Named("effort knee_r", phase, k).values, Lobatto(), true,
                  [&](double t) { return at(t).efforts[effort]; });
      const std::vector<int>& contacts = trajectory_.phases[phase].contacts;
      for (size_t c = 0; c < contacts.size(); ++c) {
        ExpectCurve(Named("normal force " + problem_->contacts[contacts[c]].name, phase, k).values, Lobatto(), true,
                    [&](double t) { return at(t).forces[3 * static_cast<int>(c) + 2]; });
      }
    }
  }
}

TEST_P(IntervalPathRowsTest, HaveTheBoundsOfTheRequest) {
  least_force_ = 0.02;
  Build(Preset::kHuman);
  const double least = 0.02 * problem_->force_size();
  const auto expect_bounds = [&](const std::string& name, double lower, double upper) {
    const Rows rows = Named(name, 1, 1);
    ASSERT_FALSE(rows.values.empty()) << name;
    for (size_t r = 0; r < rows.values.size(); ++r) {
      EXPECT_NEAR(rows.lower[r], lower, 1e-9) << name;
      if (upper == kInfinity) {
        EXPECT_EQ(rows.upper[r], kInfinity) << name;
      } else {
        EXPECT_NEAR(rows.upper[r], upper, 1e-9) << name;
      }
    }
  };
  expect_bounds("velocity knee_r", -7, 7);
  expect_bounds("range knee_r", 0.01, 1.1);
  expect_bounds("effort knee_r", -90, 80);
  const std::string contact = problem_->contacts[trajectory_.phases[1].contacts[0]].name;
  expect_bounds("normal force " + contact, least, kInfinity);
  expect_bounds("friction " + contact, 0, kInfinity);
  // The coefficient at the end of an interval is an unknown, with the same bound.
  const ActiveContact active = problem_->ActiveContacts(1)[0];
  const int last = trajectory_.points_per_interval - 1;
  const int unknown = nlp_->layout().forces(nlp_->layout().first_interval(1), last) + active.offset +
                      static_cast<int>(active.directions.size()) - 1;
  EXPECT_NEAR(nlp_->lower_bounds()(unknown) * problem_->force_size(), least, 1e-9);
}

// What the points and nodes have as bounds of unknowns: efforts at every point, ranges and velocities at every node.
TEST_P(IntervalPathRowsTest, UnknownsHaveTheBoundsOfTheRequest) {
  Build(Preset::kHuman);
  const DecisionLayout& layout = nlp_->layout();
  const std::vector<int>& actuated = problem_->model.actuated();
  const int effort = static_cast<int>(std::find(actuated.begin(), actuated.end(), knee_) - actuated.begin());
  const int n = problem_->model.size();
  for (int k = 0; k < layout.intervals(); ++k) {
    for (int i = 0; i < trajectory_.points_per_interval; ++i) {
      const int unknown = layout.efforts(k, i) + effort;
      EXPECT_NEAR(nlp_->lower_bounds()(unknown) * problem_->effort_size(), -90, 1e-9);
      EXPECT_NEAR(nlp_->upper_bounds()(unknown) * problem_->effort_size(), 80, 1e-9);
    }
    for (const int node : {layout.node(k), layout.end_node(k)}) {
      EXPECT_EQ(nlp_->lower_bounds()(node + knee_), 0.01);
      EXPECT_EQ(nlp_->upper_bounds()(node + knee_), 1.1);
      EXPECT_EQ(nlp_->lower_bounds()(node + n + knee_), -7);
      EXPECT_EQ(nlp_->upper_bounds()(node + n + knee_), 7);
    }
  }
}

// A swinging surface is held above the ground at every point but the last of a phase, where the touch-down of the next
// one says what it is.
TEST_P(IntervalPathRowsTest, SwingingSurfacesAreFreeAtTheEndOfAPhaseAlone) {
  Build(Preset::kHuman);
  int held = 0, free = 0;
  for (int r = 0; r < nlp_->constraints(); ++r) {
    const RowInfo info = nlp_->Describe(x_.data(), r);
    if (!info.name.starts_with("clearance")) continue;
    const bool at_end = std::abs(info.time - trajectory_.phases[info.phase].node_times.back()) < 1e-12;
    EXPECT_EQ(nlp_->constraint_lower()(r) == -kInfinity, at_end) << info.name << " at " << info.time;
    if (!at_end) {
      EXPECT_GE(nlp_->constraint_lower()(r), 0);
    }
    ++(at_end ? free : held);
  }
  EXPECT_GT(held, 0);
  EXPECT_GT(free, 0);
}

// Where rates of all efforts cost something, a contact that is taken up or given up has no normal force at that
// instant, and rows of friction that would have no interior are equations or nothing. With a plain squared torque there
// is no such bound.
TEST_P(IntervalPathRowsTest, ForcesVanishWhereContactsChangeAtRest) {
  for (const Preset preset : {Preset::kHuman, Preset::kTorque}) {
    Build(preset);
    const bool vanish = preset == Preset::kHuman;
    int given = 0, taken = 0;
    for (int phase = 0; phase < static_cast<int>(trajectory_.phases.size()); ++phase) {
      const int last = nlp_->layout().first_interval(phase) + kIntervals - 1,
                point = trajectory_.points_per_interval - 1;
      const std::vector<int> gives = problem_->GivenUp(phase), takes = problem_->TakenUp(phase);
      for (const ActiveContact& active : problem_->ActiveContacts(phase)) {
        const int normal = active.offset + static_cast<int>(active.directions.size()) - 1;
        const bool is_given = std::find(gives.begin(), gives.end(), active.contact) != gives.end();
        const bool is_taken = std::find(takes.begin(), takes.end(), active.contact) != takes.end();
        EXPECT_EQ(nlp_->upper_bounds()(nlp_->layout().forces(last, point) + normal) == 0, vanish && is_given);
        bool starts_at_zero;
        if (Lobatto()) {
          starts_at_zero =
              nlp_->upper_bounds()(nlp_->layout().forces(nlp_->layout().first_interval(phase), 0) + normal) == 0;
        } else {
          starts_at_zero =
              Named("normal force " + problem_->contacts[active.contact].name, phase, 0).upper.front() == 0;
        }
        EXPECT_EQ(starts_at_zero, vanish && is_taken);
        given += is_given ? 1 : 0;
        taken += is_taken ? 1 : 0;
      }
    }
    EXPECT_EQ(given, 2);  // heel and forefoot
    EXPECT_EQ(taken, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, IntervalPathRowsTest,
                         ::testing::Values(Case{"planar", Scheme::kRadau2}, Case{"planar", Scheme::kRadau3},
                                           Case{"planar", Scheme::kHermiteSimpson}, Case{"human29", Scheme::kRadau2}));

}  // namespace
}  // namespace rollgait
