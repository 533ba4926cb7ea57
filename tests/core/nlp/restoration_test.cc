// The restoration phase by itself, and what the solve does with it: restored_solve_test.cc. What it does on many
// programs: suite/suite_test.cc.
#include "core/nlp/restoration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/nlp/bound_multipliers.h"
#include "core/nlp/interior_point.h"
#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "tests/core/nlp/hs071.h"
#include "tests/core/nlp/suite/chain_program.h"
#include "tests/core/nlp/suite/measure.h"
#include "tests/support/allocation_counter.h"

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

// A phase by itself, of problem 71 of Hock and Schittkowski or one like it.
struct Phase {
  explicit Phase(NlpProblem& program) : barrier(program, options.BoundRelaxation()), newton(barrier, options) {
    EXPECT_TRUE(barrier.MakeInterior(Hs071::Start(), 0.01, &from));
    StartBoundMultipliers(barrier, from, options.initial_barrier, {}, false, &multipliers);
  }
  Restoration::End Run(const std::function<bool()>& goes_on) {
    const auto never = [](const BarrierProblem::Point&) { return false; };
    return restoration.Run(from, multipliers, options.initial_barrier, {never, goes_on});
  }
  NlpOptions options = suite::SuiteOptions();
  BarrierProblem barrier;
  NewtonSystem newton;
  Restoration restoration{barrier, newton, options};
  BarrierProblem::Point from;
  Multipliers multipliers;
};

// Squares of numbers above 1 do not add up to 3. The error that is seen is that of the point that is seen: at the last
// one it is what ends the phase.
TEST(RestorationPhase, ErrorIsThatOfThePresentIterate) {
  Hs071 program(3);
  Phase phase(program);
  std::vector<double> errors;
  const auto end = phase.Run([&] {
    errors.push_back(phase.restoration.error().scaled);
    return true;
  });
  EXPECT_EQ(end, Restoration::End::kInfeasible);
  ASSERT_GT(errors.size(), 3u);
  for (size_t i = 0; i < errors.size(); ++i)
    EXPECT_EQ(errors[i] <= phase.options.tolerance, i + 1 == errors.size()) << i;
}

TEST(RestorationPhase, IterationsAllocateNothing) {
  Hs071 program(3);
  Phase phase(program);
  std::vector<long> counts;
  counts.reserve(1000);
  phase.Run([&] {
    counts.push_back(Allocations());
    return counts.size() < 1000;
  });
  ASSERT_GT(counts.size(), 3u);
  for (size_t i = 1; i < counts.size(); ++i) EXPECT_EQ(counts[i], counts[i - 1]) << i;
}

TEST(RestorationPhase, NorDoTheOtherIterationsOfASolve) {
  Hs071 program;
  std::vector<long> counts;
  counts.reserve(1000);
  SolveControl control;
  control.observer = [&](const IterationInfo&) { counts.push_back(Allocations()); };
  SolveWithInteriorPoint(program, {Hs071::Start(), {}, {}, {}}, suite::SuiteOptions(), control);
  ASSERT_GT(counts.size(), 5u);
  for (size_t i = 2; i < counts.size(); ++i) EXPECT_EQ(counts[i], counts[i - 1]) << i;
}

// Has no values from when it is told so until its derivatives are asked for.
class Interrupted : public Hs071 {
 public:
  Interrupted() : Hs071(3) {}
  bool Constraints(const double* x, double* g) override { return has_values && Hs071::Constraints(x, g); }
  bool Derivatives(const double* x, double sigma, const double* lambda, double* jacobian, double* hessian) override {
    has_values = true;
    points.push_back(Eigen::Map<const VectorX>(x, 4));
    multipliers.push_back(Eigen::Map<const VectorX>(lambda, 2));
    return Hs071::Derivatives(x, sigma, lambda, jacobian, hessian);
  }
  bool has_values = true;
  std::vector<VectorX> points, multipliers;  // of derivatives
};

// Where the line search fails, elastic variables and multipliers are set anew; the derivatives are those of the new
// multipliers, at the same point.
TEST(RestorationPhase, DerivativesFollowTheMultipliersThatAreSetAnew) {
  Interrupted program;
  Phase phase(program);
  int seen = 0;
  size_t before = 0;
  const auto end = phase.Run([&] {
    if (++seen == 2) {
      program.has_values = false;
      before = program.points.size();
    }
    return true;
  });
  EXPECT_EQ(end, Restoration::End::kInfeasible);
  ASSERT_GT(before, 0u);
  ASSERT_GT(program.points.size(), before + 1);
  EXPECT_EQ(program.points[before], program.points[before - 1]);
  EXPECT_NE(program.multipliers[before], program.multipliers[before - 1]);
}

// Its derivatives are refused to our solver after an iteration of restoration; Ipopt asks for them one by one.
class Refused : public Hs071 {
 public:
  Refused() : Hs071(3) {}
  bool Derivatives(const double* x, double sigma, const double* lambda, double* jacobian, double* hessian) override {
    return (sigma > 0 || ++asked_ <= 2) && Hs071::Derivatives(x, sigma, lambda, jacobian, hessian);
  }

 private:
  int asked_ = 0;
};

// Ipopt takes over, iterations are numbered through, and its first point is not reported again.
TEST(RestorationPhase, IpoptTakesOverWhereItFails) {
  std::vector<IterationInfo> seen;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) { seen.push_back(info); };
  Refused program;
  const NlpResult result = SolveNlp(program, {Hs071::Start(), {}, {}, {}}, suite::SuiteOptions(), control);
  EXPECT_EQ(result.termination, Termination::kInfeasible) << result.message;
  int restored = 0;
  ASSERT_EQ(seen.size(), static_cast<size_t>(result.iterations) + 1);
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].index, static_cast<int>(i));
    EXPECT_NE(seen[i].x, nullptr) << i;
    restored += seen[i].restoration && seen[i].index <= result.restored_from ? 1 : 0;
  }
  EXPECT_EQ(restored, 1);
}

}  // namespace
}  // namespace rollgait
