// The restoration phase of the interior point method. What it does on many programs: suite/suite_test.cc.
#include "core/nlp/restoration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/nlp/interior_point.h"
#include "core/nlp/ipopt_solver.h"
#include "tests/core/nlp/hs071.h"
#include "tests/core/nlp/suite/chain_program.h"
#include "tests/core/nlp/suite/measure.h"

namespace rollgait {
namespace {

using suite::ChainProgram;

// Σ (p + n) subject to g(x) − p + n = b and the bounds of x, with p and n as unknowns like others: what restoration
// eliminates. Contract: rows are equalities or have an upper bound alone, where n stands for the slack.
class Elastic : public NlpProblem {
 public:
  explicit Elastic(NlpProblem& inner) : inner_(inner), n_(inner.variables()), m_(inner.constraints()) {
    lower_ = VectorX::Zero(n_ + 2 * m_);
    upper_ = VectorX::Constant(n_ + 2 * m_, 1e20);
    lower_.head(n_) = inner.lower_bounds();
    upper_.head(n_) = inner.upper_bounds();
    jacobian_ = inner.jacobian_pattern();
    for (int r = 0; r < m_; ++r) {
      jacobian_.Add(r, n_ + r);
      jacobian_.Add(r, n_ + m_ + r);
    }
  }
  int variables() const override { return n_ + 2 * m_; }
  int constraints() const override { return m_; }
  const VectorX& lower_bounds() const override { return lower_; }
  const VectorX& upper_bounds() const override { return upper_; }
  const VectorX& constraint_lower() const override { return inner_.constraint_upper(); }
  const VectorX& constraint_upper() const override { return inner_.constraint_upper(); }
  const SparsityPattern& jacobian_pattern() const override { return jacobian_; }
  const SparsityPattern& hessian_pattern() const override { return inner_.hessian_pattern(); }
  bool Objective(const double* x, double* value) override {
    *value = 0;
    for (int k = 0; k < 2 * m_; ++k) *value += Weight(k) * x[n_ + k];
    return true;
  }
  bool Gradient(const double*, double* gradient) override {
    std::fill_n(gradient, n_, 0.0);
    for (int k = 0; k < 2 * m_; ++k) gradient[n_ + k] = Weight(k);
    return true;
  }
  bool Constraints(const double* x, double* g) override {
    if (!inner_.Constraints(x, g)) return false;
    for (int r = 0; r < m_; ++r) g[r] += x[n_ + m_ + r] - x[n_ + r];
    return true;
  }
  bool Jacobian(const double* x, double* values) override {
    if (!inner_.Jacobian(x, values)) return false;
    for (double* value = values + inner_.jacobian_pattern().size(); value < values + jacobian_.size(); value += 2) {
      value[0] = -1;
      value[1] = 1;
    }
    return true;
  }
  bool Hessian(const double* x, double, const double* lambda, double* values) override {
    return inner_.Hessian(x, 0, lambda, values);
  }

 private:
  double Weight(int k) const {
    return k >= m_ && inner_.constraint_lower()(k - m_) < inner_.constraint_upper()(k - m_) ? 0 : 1;
  }
  NlpProblem& inner_;
  int n_, m_;
  VectorX lower_, upper_;
  SparsityPattern jacobian_;
};

// Final states that the controls cannot reach; without sines the minimum is the only one. Ipopt, with the elastic
// variables among the unknowns, finds the same sum of violations.
TEST(Restoration, EndsInTheMinimumOfTheSumOfViolations) {
  for (const unsigned seed : {11u, 12u, 13u}) {
    ChainProgram chain({seed, 8, 0, 0, true, 30});
    const NlpStart start{VectorX::Constant(chain.variables(), 0.1), {}, {}, {}};
    const InteriorPointResult ours = SolveWithInteriorPoint(chain, start, suite::SuiteOptions(), {});
    EXPECT_FALSE(ours.needs_restoration);
    ASSERT_EQ(ours.result.termination, Termination::kInfeasible) << ours.result.message;
    Elastic elastic(chain);
    VectorX x = VectorX::Ones(elastic.variables());
    x.head(chain.variables()) = ours.result.x;
    const NlpResult second = SolveWithIpopt(elastic, {x, {}, {}, {}}, suite::SuiteOptions(), {});
    ASSERT_EQ(second.termination, Termination::kOptimal) << second.message;
    EXPECT_GT(second.objective, 1);
    // Both stop at an error of 1e-8 in each of some hundred terms.
    EXPECT_NEAR(suite::SumOfViolations(chain, ours.result.x), second.objective, 1e-5) << seed;
  }
}

// Problem 65 of Hock and Schittkowski goes through restoration and ends at its solution.
class Restored : public ::testing::Test {
 protected:
  static suite::SuiteRow Row() {
    for (const suite::SuiteRow& row : suite::HockSchittkowskiLarge()) {
      if (row.name == "HS65") return row;
    }
    return {};
  }
  InteriorPointResult Solve(const NlpOptions& options, const SolveControl& control,
                            const Resumption& resumption = {}) const {
    const auto program = Row().make();
    return SolveWithInteriorPoint(*program, suite::StartOf(Row()), options, control, resumption);
  }
};

TEST_F(Restored, IterationsAreNumberedThroughAndMarked) {
  std::vector<IterationInfo> seen;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) { seen.push_back(info); };
  const InteriorPointResult out = Solve(suite::SuiteOptions(), control);
  ASSERT_EQ(out.result.termination, Termination::kOptimal) << out.result.message;
  ASSERT_EQ(static_cast<int>(seen.size()), out.result.iterations + 1);
  int restored = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].index, static_cast<int>(i));
    if (!seen[i].restoration) continue;
    ++restored;
    ASSERT_GT(i, 0u);
    EXPECT_LT(seen[i].primal_infeasibility, seen[i - 1].primal_infeasibility);
  }
  EXPECT_GT(restored, 0);
}

TEST_F(Restored, IsStoppedWithinIt) {
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  int last = -1;
  control.observer = [&](const IterationInfo& info) {
    last = info.index;
    if (info.restoration) stop.Request();
  };
  const InteriorPointResult out = Solve(suite::SuiteOptions(), control);
  EXPECT_EQ(out.result.termination, Termination::kCancelled);
  EXPECT_FALSE(out.needs_restoration);
  EXPECT_EQ(out.result.iterations, last);
}

TEST_F(Restored, IsSubjectToTheIterationLimit) {
  int first = -1;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) {
    if (info.restoration && first < 0) first = info.index;
  };
  Solve(suite::SuiteOptions(), control);
  ASSERT_GT(first, 0);
  NlpOptions options = suite::SuiteOptions();
  options.max_iterations = first;
  const InteriorPointResult out = Solve(options, {});
  EXPECT_EQ(out.result.termination, Termination::kIterationLimit);
  EXPECT_EQ(out.result.iterations, first);
  EXPECT_FALSE(out.needs_restoration);
}

// A state from before it and one from after it lead to the same end, to the last bit.
TEST_F(Restored, GoesOnFromAnyState) {
  struct AllStates : StateKeeper {
    bool IsDue(int) override { return true; }
    void Keep(const InteriorPointState& state) override { states.push_back(state); }
    std::vector<InteriorPointState> states;
  } keeper;
  const InteriorPointResult whole = Solve(suite::SuiteOptions(), {}, {nullptr, &keeper});
  ASSERT_GT(keeper.states.size(), 3u);
  for (const InteriorPointState& state : keeper.states) {
    const InteriorPointResult rest = Solve(suite::SuiteOptions(), {}, {&state, nullptr});
    EXPECT_EQ(rest.result.x, whole.result.x) << state.iteration;
    EXPECT_EQ(rest.result.iterations, whole.result.iterations) << state.iteration;
  }
}

}  // namespace
}  // namespace rollgait
