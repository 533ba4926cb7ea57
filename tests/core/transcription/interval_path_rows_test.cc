// The rows between the points are Bernstein coefficients of the curves that the trajectory states, and have the bounds
// of the problem. Those of friction have a test of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/core/transcription/path_rows_fixture.h"

namespace rollgait {
namespace {

class IntervalPathRowsTest : public PathRowsFixture {};

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

// A phase may narrow the efforts of joints, at points and between them.
TEST_P(IntervalPathRowsTest, EffortsHaveTheBoundsOfTheirPhase) {
  Build(Preset::kHuman);
  const std::vector<int>& actuated = problem_->model.actuated();
  const size_t effort = static_cast<size_t>(std::find(actuated.begin(), actuated.end(), knee_) - actuated.begin());
  std::vector<Interval>& bounds = problem_->phases[1].efforts;
  bounds.resize(actuated.size());
  bounds[effort] = {-200, 10};  // the joint has at least -90
  nlp_ = std::make_unique<CollocationNlp>(*problem_, GetParam().scheme, nlp_->mesh(), added_);
  for (const int phase : {0, 1}) {
    const double most = phase == 0 ? 80 : 10;
    const Rows rows = Named("effort knee_r", phase, 1);
    ASSERT_FALSE(rows.upper.empty());
    for (size_t r = 0; r < rows.upper.size(); ++r) {
      EXPECT_NEAR(rows.lower[r], -90, 1e-9);
      EXPECT_NEAR(rows.upper[r], most, 1e-9);
    }
    const DecisionLayout& layout = nlp_->layout();
    for (int i = 0; i < layout.points(); ++i) {
      const int unknown = layout.efforts(layout.first_interval(phase), i) + static_cast<int>(effort);
      EXPECT_NEAR(nlp_->lower_bounds()(unknown) * problem_->effort_size(), -90, 1e-9);
      EXPECT_NEAR(nlp_->upper_bounds()(unknown) * problem_->effort_size(), most, 1e-9);
    }
  }
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

INSTANTIATE_TEST_SUITE_P(
    Schemes, IntervalPathRowsTest,
    ::testing::Values(PathRowsCase{"planar", Scheme::kRadau2}, PathRowsCase{"planar", Scheme::kRadau3},
                      PathRowsCase{"planar", Scheme::kHermiteSimpson}, PathRowsCase{"planar", Scheme::kRadau4},
                      PathRowsCase{"planar", Scheme::kLobatto5}, PathRowsCase{"human29", Scheme::kRadau2}));

}  // namespace
}  // namespace rollgait
