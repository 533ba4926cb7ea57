#ifndef ROLLGAIT_TESTS_CORE_TRANSCRIPTION_PATH_ROWS_FIXTURE_H_
#define ROLLGAIT_TESTS_CORE_TRANSCRIPTION_PATH_ROWS_FIXTURE_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/trajectory/sampling.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

struct PathRowsCase {
  const char* model;
  Scheme scheme;
};

// A walk of two intervals a phase, off any solution, whose NLP has every row between points that there is: bounds of a
// knee, and friction pyramids with one edge more than the usual ones.
class PathRowsFixture : public ::testing::TestWithParam<PathRowsCase> {
 protected:
  static constexpr int kIntervals = 2;   // a phase
  static constexpr int kAddedEdge = 12;  // 60°, in space

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
    added_.between.assign(problem_->phases.size(), {{knee_}, {knee_}, {knee_}, {}});
    for (size_t p = 0; p < problem_->phases.size(); ++p) {
      for (int contact : problem_->phases[p].active) added_.between[p].friction.push_back({contact, kAddedEdge});
    }
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

  bool InSpace() const { return problem_->contacts[0].directions.size() == 3; }
  bool Lobatto() const { return TraitsOf(GetParam().scheme).points.front() == 0; }

  double least_force_ = 0;
  int knee_ = 0;
  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  AddedConstraints added_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_, g_;
  Trajectory trajectory_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_TRANSCRIPTION_PATH_ROWS_FIXTURE_H_
