// What the interior point method of our own does beyond what every solver must (nlp_solver_test.cc).
#include "core/nlp/interior_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

// Both methods are the same algorithm: the objectives, barrier parameters and step lengths of all iterations agree.
TEST(InteriorPoint, TakesTheIterationsOfIpopt) {
  std::vector<IterationInfo> ours, ipopt;
  SolveControl control;
  Hs071 problem;
  control.observer = [&ours](const IterationInfo& info) { ours.push_back(info); };
  SolveWithInteriorPoint(problem, {Hs071::Start(), {}, {}, {}}, {}, control);
  control.observer = [&ipopt](const IterationInfo& info) { ipopt.push_back(info); };
  SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, {}, control);
  ASSERT_EQ(ours.size(), ipopt.size());
  for (size_t i = 0; i < ours.size(); ++i) {
    EXPECT_NEAR(ours[i].objective, ipopt[i].objective, 1e-6) << i;
    EXPECT_NEAR(ours[i].primal_step, ipopt[i].primal_step, 1e-5) << i;
    EXPECT_NEAR(ours[i].barrier_parameter, ipopt[i].barrier_parameter, 1e-9) << i;
    EXPECT_NEAR(ours[i].primal_infeasibility, ipopt[i].primal_infeasibility,
                1e-6 + 1e-5 * ipopt[i].primal_infeasibility);
  }
}

// It is asked once, at the first iterate that is good enough, and obeyed.
TEST(InteriorPoint, EndsRoughlyWhereItIsNotWorthFinishing) {
  Hs071 problem(40);
  const NlpStart start{Hs071::Start(), {}, {}, {}};
  NlpOptions options;
  options.tolerance = 1e-9;
  const NlpResult whole = SolveWithInteriorPoint(problem, start, options, {}).result;
  EXPECT_FALSE(whole.rough);
  for (const bool answer : {true, false}) {
    int asked = 0;
    options.rough_tolerance = 1e-2;
    options.worth_finishing = [&](const VectorX& x) {
      ++asked;
      EXPECT_EQ(x.size(), 4);
      EXPECT_NEAR(x(1), whole.x(1), 0.1);
      EXPECT_GT((x - whole.x).norm(), 1e-7);
      return answer;
    };
    const NlpResult result = SolveWithInteriorPoint(problem, start, options, {}).result;
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(result.termination, Termination::kOptimal);
    EXPECT_EQ(result.rough, !answer);
    if (answer) {
      EXPECT_EQ(result.iterations, whole.iterations);
      EXPECT_EQ(result.x, whole.x);
    } else {
      EXPECT_LT(result.iterations, whole.iterations);
      EXPECT_LE(result.kkt_error, 1e-2);
      EXPECT_GT(result.kkt_error, 1e-9);
    }
  }
}

// Problem 71 with its equality a second time, multiplied: what elimination leaves of that row is rounding.
class Repeated : public Hs071 {
 public:
  explicit Repeated(double factor) : factor_(factor) {
    row_lower_ = Eigen::Vector3d(25, 40, 40 * factor);
    row_upper_ = Eigen::Vector3d(kInfinity, 40, 40 * factor);
    jacobian_ = Hs071::jacobian_pattern();
    for (int c = 0; c < 4; ++c) jacobian_.Add(2, c);
  }
  int constraints() const override { return 3; }
  const VectorX& constraint_lower() const override { return row_lower_; }
  const VectorX& constraint_upper() const override { return row_upper_; }
  const SparsityPattern& jacobian_pattern() const override { return jacobian_; }
  bool Constraints(const double* x, double* g) override {
    Hs071::Constraints(x, g);
    g[2] = factor_ * g[1];
    return true;
  }
  bool Jacobian(const double* x, double* values) override {
    Hs071::Jacobian(x, values);
    for (int c = 0; c < 4; ++c) values[8 + c] = factor_ * values[4 + c];
    return true;
  }
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override {
    const double folded[] = {lambda[0], lambda[1] + factor_ * lambda[2]};
    return Hs071::Hessian(x, sigma, folded, values);
  }

 private:
  double factor_;
  VectorX row_lower_, row_upper_;
  SparsityPattern jacobian_;
};

TEST(InteriorPoint, RowsThatDependOnEachOtherButForRounding) {
  for (const double factor : {0.1, 0.3, 1 / 3.0, 0.7, 1.1, 1.7, 2.3, 7.7}) {
    Repeated problem(factor);
    NlpOptions options;
    options.tolerance = 1e-9;
    const InteriorPointResult out = SolveWithInteriorPoint(problem, {Hs071::Start(), {}, {}, {}}, options, {});
    EXPECT_EQ(out.result.termination, Termination::kOptimal) << factor << ": " << out.result.message;
    EXPECT_NEAR(out.result.objective, 17.0140173, 1e-6) << factor;
  }
}

// ½ x² whose last digits are lost, so near its minimum no step lowers it, and whose derivative is off by `error` times
// the sign of x.
class Coarse : public StoredProgram {
 public:
  explicit Coarse(double error) : error_(error) {
    lower_ = VectorX::Constant(1, -1e20);
    upper_ = -lower_;
    hessian_.Add(0, 0);
  }
  bool Objective(const double* x, double* value) override {
    const volatile double large = 1 << 26;  // an ulp of 1.5e-8
    const volatile double sum = large + 0.5 * x[0] * x[0];
    *value = sum - large;
    return true;
  }
  bool Gradient(const double* x, double* gradient) override {
    gradient[0] = x[0] + std::copysign(error_, x[0]);
    return true;
  }
  bool Constraints(const double*, double*) override { return true; }
  bool Jacobian(const double*, double*) override { return true; }
  bool Hessian(const double*, double sigma, const double*, double* values) override {
    values[0] = sigma;
    return true;
  }

 private:
  double error_;
};

TEST(InteriorPoint, StepsPastTheFilterWhereItComparesRoundings) {
  Coarse problem(0);
  const InteriorPointResult out = SolveWithInteriorPoint(problem, {VectorX::Constant(1, 1e-5), {}, {}, {}}, {}, {});
  EXPECT_EQ(out.result.termination, Termination::kOptimal) << out.result.message;
  EXPECT_NEAR(out.result.x(0), 0, 1e-20);
}

// Where no step helps, nothing is to be restored at a point that is good to 100 times the tolerance; beyond that there
// is.
TEST(InteriorPoint, EndsWhereNothingHelps) {
  Coarse near(2e-5), far(2e-4);
  const NlpStart start{VectorX::Constant(1, 1e-6), {}, {}, {}};
  const InteriorPointResult good = SolveWithInteriorPoint(near, start, {}, {});
  EXPECT_EQ(good.result.termination, Termination::kAcceptable) << good.result.message;
  EXPECT_FALSE(good.needs_restoration);
  EXPECT_TRUE(SolveWithInteriorPoint(far, start, {}, {}).needs_restoration);
}

// Nothing can be restored where nothing is violated: Ipopt takes over, and iterations are numbered through.
TEST(InteriorPoint, IpoptTakesOverWhereRestorationIsOfNoUse) {
  Coarse problem(2e-4);
  const NlpStart start{VectorX::Constant(1, 1e-6), {}, {}, {}};
  const InteriorPointResult alone = SolveWithInteriorPoint(problem, start, {}, {});
  EXPECT_TRUE(alone.needs_restoration);
  std::vector<int> indices;
  SolveControl control;
  int restored = 0;
  control.observer = [&](const IterationInfo& info) {
    indices.push_back(info.index);
    restored += info.restoration ? 1 : 0;
  };
  NlpOptions options;
  options.max_iterations = alone.result.iterations + 20;  // its derivatives are wrong: Ipopt does not converge either
  const NlpResult both = SolveNlp(problem, start, options, control);
  EXPECT_EQ(both.restored_from, alone.result.iterations);
  EXPECT_EQ(restored, both.iterations - alone.result.iterations);
  ASSERT_FALSE(indices.empty());
  for (size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(indices[i], static_cast<int>(i));
}

// From a solution without multipliers: estimated, they end it at once; a cold start goes away first.
TEST(InteriorPoint, EstimatesMultipliersOfASolution) {
  Hs071 problem;
  NlpOptions options;
  options.tolerance = 1e-9;
  const NlpResult solution = SolveWithInteriorPoint(problem, {Hs071::Start(), {}, {}, {}}, options, {}).result;
  ASSERT_EQ(solution.termination, Termination::kOptimal);
  const NlpStart start{solution.x, {}, {}, {}};
  options.initial_barrier = BarrierParameter::Least(options.tolerance);
  options.warm_push = 1e-12;
  EXPECT_GT(SolveWithInteriorPoint(problem, start, options, {}).result.iterations, 3);
  options.estimate_multipliers = true;
  const NlpResult again = SolveWithInteriorPoint(problem, start, options, {}).result;
  EXPECT_EQ(again.termination, Termination::kOptimal);
  EXPECT_LE(again.iterations, 1);
  EXPECT_NEAR((again.x - solution.x).norm(), 0, 1e-8);
  EXPECT_NEAR((again.constraint_multipliers - solution.constraint_multipliers).norm(), 0, 1e-6);
}

// At wrong bounds with a small barrier steps are short until the barrier is raised; Problem 71 has three minima.
TEST(InteriorPoint, RaisesTheBarrierWhereStepsAreShort) {
  NlpOptions options;
  options.initial_barrier = 1e-3;
  options.warm_push = 1e-8;
  options.barrier_tolerance = 1000;
  options.barrier_exponent = 2.2;
  const VectorX none = VectorX::Zero(4);
  int raised = 0;
  for (const Eigen::Vector4d& x : {Eigen::Vector4d(1, 1, 1.1, 3.1), {1, 1, 1.4, 3.9}, {1, 1, 1.5, 4}}) {
    Hs071 problem;
    std::vector<double> barriers;
    SolveControl control;
    control.observer = [&](const IterationInfo& info) { barriers.push_back(info.barrier_parameter); };
    const NlpStart start{x, VectorX::Zero(2), none, none};
    const NlpResult result = SolveWithInteriorPoint(problem, start, options, control).result;
    EXPECT_EQ(result.termination, Termination::kOptimal) << x.transpose() << ": " << result.message;
    if (!std::is_sorted(barriers.rbegin(), barriers.rend())) ++raised;
  }
  EXPECT_GT(raised, 0);
}

}  // namespace
}  // namespace rollgait
