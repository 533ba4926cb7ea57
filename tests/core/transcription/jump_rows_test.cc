// The rows of a jump determine it: solved for the velocities after it and the impulses they give what the judge's
// plastic impact gives, in the plane and in space, at a border of phases and through the mirror at the start of a half
// cycle.
#include "core/transcription/jump_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/contact/rolling_kinematics.h"
#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "core/validation/jumps.h"

namespace rollgait {
namespace {

constexpr JointSpring kNoSpring, kStiffSpring{2000, 0.2, 50};

struct Case {
  const char* model;
  Cycle cycle;
  JointSpring spring;  // in both ankles
};

class JumpRowsTest : public ::testing::TestWithParam<Case> {
 protected:
  JumpRowsTest() {
    spec_ = std::make_unique<GaitSpec>(SpecWith(GetParam().spring));
    problem_ = BuildProblem(*spec_);
    nlp_ = NlpOf(*problem_);
    x_ = nlp_->MakeStart(WalkingGuess(*spec_, *problem_));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    n_ = problem_->model.size();
    for (int k = 0; k < nlp_->layout().intervals(); ++k) {
      for (int j = 0; j < n_; ++j) x_(nlp_->layout().end_node(k) + n_ + j) += noise(random);
    }
  }

  static GaitSpec SpecWith(const JointSpring& spring) {
    GaitRequest request;
    request.body.model = GetParam().model;
    request.body.feet = FootShape::kTwoEllipsoids;
    request.body.changes.springs = {{"ankle_l", spring}, {"ankle_r", spring}};
    request.cycle = GetParam().cycle;
    request.slope = 0.1;
    request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
    return CheckRequest(request).value();
  }
  static std::unique_ptr<CollocationNlp> NlpOf(const OptimalControlProblem& problem) {
    return std::make_unique<CollocationNlp>(problem, Scheme::kRadau2,
                                            Mesh::Uniform(std::vector<int>(problem.phases.size(), 1)));
  }

  // Rows that hold a phase's velocities after its jump and its impulses. They are linear in them, and leave open what
  // the surfaces of one foot bear along the line that joins them.
  std::vector<int> RowsOf(int phase) const {
    std::vector<int> rows;
    bool entries = false;
    for (int row = 0; row < nlp_->constraints(); ++row) {
      const RowInfo info = nlp_->Describe(x_.data(), row);
      entries |= info.name.starts_with("touch-down");
      if (!entries || info.phase != phase) continue;
      if (info.name.starts_with("rolling") || info.name.starts_with("impact, dynamics")) rows.push_back(row);
    }
    return rows;
  }

  // Feet that stand on two surfaces.
  size_t SharedLinks(int phase) const {
    std::set<int> links;
    const std::vector<int>& active = problem_->phases[phase].active;
    for (int contact : active) links.insert(problem_->contacts[contact].joint);
    return active.size() - links.size();
  }

  void SolveJump(int phase) {
    const DecisionLayout& layout = nlp_->layout();
    std::vector<int> unknowns;
    for (int j = 0; j < n_; ++j) unknowns.push_back(layout.node(layout.first_interval(phase)) + n_ + j);
    for (int i = 0; i < layout.impulse_size(phase); ++i) unknowns.push_back(layout.impulse(phase) + i);
    const std::vector<int> rows = RowsOf(phase);
    ASSERT_EQ(rows.size() + SharedLinks(phase), unknowns.size());
    NewtonStep(rows, unknowns);
  }

  void NewtonStep(const std::vector<int>& rows, const std::vector<int>& unknowns) {
    VectorX values(nlp_->jacobian_pattern().size()), g(nlp_->constraints());
    ASSERT_TRUE(nlp_->Jacobian(x_.data(), values.data()));
    ASSERT_TRUE(nlp_->Constraints(x_.data(), g.data()));
    MatrixX jacobian = MatrixX::Zero(nlp_->constraints(), nlp_->variables());
    for (int e = 0; e < values.size(); ++e) {
      jacobian(nlp_->jacobian_pattern().rows[e], nlp_->jacobian_pattern().columns[e]) += values(e);
    }
    const VectorX step = jacobian(rows, unknowns).completeOrthogonalDecomposition().solve(-g(rows));
    x_(unknowns) += step;
  }

  void SolveJumps() {
    for (int p = 0; p < nlp_->layout().phases(); ++p) {
      if (nlp_->layout().jumps(p)) SolveJump(p);
    }
  }

  JumpErrors Judge(const Trajectory& trajectory) const {
    ForceExtremes impulses(1);
    return MeasureJumps(spec_->scene, BodyDynamics(spec_->scene.model), trajectory, &impulses);
  }

  int n_ = 0;
  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_;
};

// Velocities are of size 1 to 10, impulses of size 100.
TEST_P(JumpRowsTest, SolvedTheyGiveThePlasticImpact) {
  SolveJumps();
  const Trajectory trajectory = nlp_->Extract(x_.data());
  const JumpErrors errors = Judge(trajectory);
  EXPECT_LT(errors.velocity, 1e-10);
  EXPECT_LT(errors.impulse, 1e-10);
  int jumps = 0;
  double loss = 0;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    if (!Jumps(phase)) continue;
    ++jumps;
    loss += phase.impact_loss;
    EXPECT_GT(phase.impact_loss, 0.1);  // a projection in the metric of the mass matrix: energy never rises
    EXPECT_GT(phase.impulses.norm(), 0.1);
  }
  EXPECT_EQ(jumps, GetParam().cycle == Cycle::kHalf ? 2 : 4);  // heel and forefoot
  EXPECT_NEAR(loss, errors.loss, 1e-9 * loss);
}

// Impulses are proportional to the velocities that they stop.
TEST_P(JumpRowsTest, ImpulsesAreProportionalToWhatTheyStop) {
  SolveJumps();
  const Trajectory first = nlp_->Extract(x_.data());
  const DecisionLayout& layout = nlp_->layout();
  for (const double share : {0.5, 0.01}) {
    VectorX x = x_;
    for (int p = 1; p < layout.phases(); ++p) {
      if (!layout.jumps(p)) continue;
      const int before = layout.end_node(layout.first_interval(p) - 1) + n_;
      const auto after = x_.segment(layout.node(layout.first_interval(p)) + n_, n_);
      x.segment(before, n_) = after + share * (x_.segment(before, n_) - after);
    }
    const VectorX kept = x_;
    x_ = x;
    SolveJumps();
    const Trajectory scaled = nlp_->Extract(x_.data());
    x_ = kept;
    for (size_t p = 1; p < first.phases.size(); ++p) {
      if (!Jumps(first.phases[p])) continue;
      EXPECT_LT((scaled.phases[p].impulses - share * first.phases[p].impulses).norm(),
                1e-9 * first.phases[p].impulses.norm());
      EXPECT_NEAR(scaled.phases[p].impact_loss, share * share * first.phases[p].impact_loss,
                  1e-9 * first.phases[p].impact_loss);
    }
  }
}

// A spring and a damper are finite forces, which have no impulse.
TEST_P(JumpRowsTest, DoNotDependOnSprings) {
  const GaitSpec spec = SpecWith(kStiffSpring);
  const std::unique_ptr<OptimalControlProblem> problem = BuildProblem(spec);
  const std::unique_ptr<CollocationNlp> stiff = NlpOf(*problem);
  const SparsityPattern& pattern = nlp_->jacobian_pattern();
  ASSERT_EQ(stiff->constraints(), nlp_->constraints());
  ASSERT_EQ(stiff->jacobian_pattern().rows, pattern.rows);
  ASSERT_EQ(stiff->jacobian_pattern().columns, pattern.columns);
  VectorX g(nlp_->constraints()), g_stiff = g, values(pattern.size()), values_stiff = values;
  ASSERT_TRUE(nlp_->Constraints(x_.data(), g.data()) && stiff->Constraints(x_.data(), g_stiff.data()));
  ASSERT_TRUE(nlp_->Jacobian(x_.data(), values.data()) && stiff->Jacobian(x_.data(), values_stiff.data()));
  std::vector<char> is_impact;
  double largest = 0;
  for (int row = 0; row < nlp_->constraints(); ++row) {
    const std::string name = nlp_->Describe(x_.data(), row).name;
    is_impact.push_back(name.starts_with("impact"));
    if (!is_impact.back()) continue;
    EXPECT_EQ(g(row), g_stiff(row)) << name;
    largest = std::max(largest, std::abs(g(row)));
  }
  EXPECT_GT(largest, 0.1);
  for (size_t e = 0; e < pattern.rows.size(); ++e) {
    if (!is_impact[pattern.rows[e]]) continue;
    EXPECT_EQ(values[e], values_stiff[e]) << e;
  }
}

// Of all impulses that stop the same velocities the least are returned, whichever of them the solver found.
TEST_P(JumpRowsTest, ImpulsesOfOneFootAreTheLeast) {
  const BodyDynamics dynamics(spec_->scene.model);
  int shared = 0;
  for (int p = 0; p < nlp_->layout().phases(); ++p) {
    if (!nlp_->layout().jumps(p) || SharedLinks(p) == 0) continue;
    const std::vector<ActiveContact> active = problem_->ActiveContacts(p);
    BodyDynamics::State state;
    dynamics.ComputeState(x_.segment(nlp_->layout().node(nlp_->layout().first_interval(p)), n_), VectorX::Zero(n_),
                          &state);
    const auto place = [&](size_t i) {
      return ComputeRollingContact(problem_->contacts[active[i].contact], state).p_WP;
    };
    size_t last = 1;
    while (problem_->contacts[active[last].contact].joint != problem_->contacts[active[0].contact].joint) ++last;
    Vector3 line = place(last) - place(0);
    if (active[0].directions.size() == 2) line.y() = 0;
    line.normalize();
    const Vector3 one(0.1, 0.02, 1), other(-0.05, 0.01, 0.8);
    const auto impulses = [&](double along_the_line) {
      VectorX x = x_;
      for (const size_t i : {size_t{0}, last}) {
        const Vector3 impulse = i == 0 ? Vector3(one + along_the_line * line) : Vector3(other - along_the_line * line);
        for (size_t d = 0; d < active[i].directions.size(); ++d) {
          x(nlp_->layout().impulse(p) + active[i].offset + static_cast<int>(d)) = impulse(active[i].directions[d]);
        }
      }
      return VectorX(nlp_->Extract(x.data()).phases[p].impulses / problem_->impulse_size());
    };
    const VectorX least = impulses(0);
    const auto first = least.head<3>(), second = least.segment<3>(3 * static_cast<int>(last));
    EXPECT_NEAR(first.x() + second.x(), 0.05, 1e-12);
    EXPECT_NEAR(first.z() + second.z(), 1.8, 1e-12);
    // The least: neither more nor less along the line makes the sum of squares smaller.
    EXPECT_NEAR((first - second).dot(line), 0, 1e-9) << "phase " << p;
    EXPECT_LT((impulses(0.3) - least).norm(), 1e-9) << "phase " << p;
    EXPECT_LT((impulses(-2) - least).norm(), 1e-9) << "phase " << p;
    ++shared;
  }
  EXPECT_EQ(shared, GetParam().cycle == Cycle::kHalf ? 1 : 2);
}

INSTANTIATE_TEST_SUITE_P(Models, JumpRowsTest,
                         ::testing::Values(Case{"planar", Cycle::kHalf, kNoSpring},
                                           Case{"planar", Cycle::kFull, {300, 0, 1}},
                                           Case{"human29", Cycle::kHalf, {300, 0.1, 0}},
                                           Case{"human29", Cycle::kFull, kNoSpring}));

}  // namespace
}  // namespace rollgait
