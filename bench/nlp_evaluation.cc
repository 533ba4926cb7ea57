// Time of one evaluation of the NLP per collocation point, of the planar and the spatial human: constraints, Jacobian,
// Hessian, and beside them one factorisation and one solution of the Newton system at the optimum; and the dynamics
// kernels. That none of these allocates is held by tests/core/transcription/allocation_test.cc and
// tests/core/nlp/frontal_ldlt_test.cc.
//   nlp_evaluation [--benchmark_...]   (Google Benchmark; one thread; Release; OPENBLAS_NUM_THREADS=1)

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/nlp/kkt_system.h"
#include "core/nlp/solve_nlp.h"

namespace rollgait {
namespace {

constexpr const char* kModels[] = {"planar", "human29"};
constexpr const char* kSchemes[] = {"radau2", "radau3", "hermite-simpson"};

struct Problem {
  Problem(Scheme scheme, const std::string& model) {
    GaitRequest request;
    request.body.model = model;
    request.motion.speed = 1.3;
    request.costs = {{cost::SquaredTorque{}, 1.0}, {cost::SquaredTorqueRate{}, 1e-4}};
    spec = std::make_unique<GaitSpec>(CheckRequest(request).value());
    ocp = BuildProblem(*spec);
    nlp = std::make_unique<CollocationNlp>(*ocp, scheme, Mesh::Uniform({8, 16}));
    x = nlp->MakeStart(WalkingGuess(*spec, *ocp));
    points = 24 * nlp->layout().points();
    lambda = VectorX::Ones(nlp->constraints());
    g.resize(nlp->constraints());
    jacobian.resize(nlp->jacobian_pattern().size());
    hessian.resize(nlp->hessian_pattern().size());
  }
  explicit Problem(const benchmark::State& state)
      : Problem(static_cast<Scheme>(state.range(1)), kModels[state.range(0)]) {}
  std::unique_ptr<GaitSpec> spec;
  std::unique_ptr<OptimalControlProblem> ocp;
  std::unique_ptr<CollocationNlp> nlp;
  VectorX x, lambda, g, jacobian, hessian;
  int points;
};

void PerPoint(benchmark::State& state, int points) {
  state.SetLabel(std::string(kModels[state.range(0)]) + " " + kSchemes[state.range(1)]);
  state.counters["ns_per_point"] = benchmark::Counter(static_cast<double>(state.iterations()) * points * 1e-9,
                                                      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void Constraints(benchmark::State& state) {
  Problem p(state);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(p.nlp->Constraints(p.x.data(), p.g.data()));
  PerPoint(state, p.points);
}
void Jacobian(benchmark::State& state) {
  Problem p(state);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(p.nlp->Jacobian(p.x.data(), p.jacobian.data()));
  PerPoint(state, p.points);
}
void Hessian(benchmark::State& state) {
  Problem p(state);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(p.nlp->Hessian(p.x.data(), 1, p.lambda.data(), p.hessian.data()));
  PerPoint(state, p.points);
}
// One evaluation as a solver's iteration needs it.
void AllThree(benchmark::State& state) {
  Problem p(state);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(p.nlp->Constraints(p.x.data(), p.g.data()));
    benchmark::DoNotOptimize(p.nlp->Derivatives(p.x.data(), 1, p.lambda.data(), p.jacobian.data(), p.hessian.data()));
  }
  PerPoint(state, p.points);
}

// The matrix of the last iteration: curvatures of the bounds from their multipliers and distances.
struct NewtonMatrix {
  explicit NewtonMatrix(Problem& p) : kkt(*p.nlp, Fixed(*p.nlp), Inequalities(*p.nlp), NlpOptions().step_residual) {
    const NlpResult at = SolveNlp(*p.nlp, {p.x, {}, {}, {}}, {}, {});
    p.nlp->Derivatives(at.x.data(), 1, at.constraint_multipliers.data(), kkt.jacobian(), kkt.hessian());
    kkt.TakeDerivatives();
    primal = VectorX::Zero(p.nlp->variables());
    dual = VectorX::Zero(p.nlp->constraints());
    for (int i = 0; i < primal.size(); ++i) {
      const double below = at.x(i) - p.nlp->lower_bounds()(i), above = p.nlp->upper_bounds()(i) - at.x(i);
      primal(i) = at.lower_bound_multipliers(i) / std::max(below, kLeast) +
                  at.upper_bound_multipliers(i) / std::max(above, kLeast);
    }
    for (const int r : Inequalities(*p.nlp)) {
      dual(r) = 1 / std::max(1e-6, std::abs(at.constraint_multipliers(r)) / kTypical);
    }
    right_x = VectorX::Ones(primal.size());
    right_g = VectorX::Ones(dual.size());
    ROLLGAIT_CHECK(kkt.Factorise(primal, dual) == KktSystem::Outcome::kRight);
  }
  static std::vector<char> Fixed(const NlpProblem& nlp) {
    std::vector<char> fixed;
    for (int i = 0; i < nlp.variables(); ++i) fixed.push_back(nlp.lower_bounds()(i) == nlp.upper_bounds()(i) ? 1 : 0);
    return fixed;
  }
  static std::vector<int> Inequalities(const NlpProblem& nlp) {
    std::vector<int> rows;
    for (int r = 0; r < nlp.constraints(); ++r) {
      if (nlp.constraint_lower()(r) < nlp.constraint_upper()(r)) rows.push_back(r);
    }
    return rows;
  }
  static constexpr double kLeast = 1e-9, kTypical = 1e-3;  // distances to bounds
  KktSystem kkt;
  VectorX primal, dual, right_x, right_g, u, v;
};

void Factorisation(benchmark::State& state) {
  Problem p(state);
  NewtonMatrix matrix(p);
  for ([[maybe_unused]] auto _ : state) {
    matrix.kkt.TakeDerivatives();
    benchmark::DoNotOptimize(matrix.kkt.Factorise(matrix.primal, matrix.dual));
  }
  PerPoint(state, p.points);
}
void Solution(benchmark::State& state) {
  Problem p(state);
  NewtonMatrix matrix(p);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(matrix.kkt.Solve(matrix.right_x, matrix.right_g, &matrix.u, &matrix.v));
  }
  PerPoint(state, p.points);
}
BENCHMARK(Constraints)->ArgsProduct({{0, 1}, {0, 1, 2}});
BENCHMARK(Jacobian)->ArgsProduct({{0, 1}, {0, 1, 2}});
BENCHMARK(Hessian)->ArgsProduct({{0, 1}, {0, 1, 2}});
BENCHMARK(AllThree)->ArgsProduct({{0, 1}, {0, 1, 2}});
BENCHMARK(Factorisation)->ArgsProduct({{0, 1}, {0, 1, 2}});
BENCHMARK(Solution)->ArgsProduct({{0, 1}, {0, 1, 2}});

struct Tree {
  Tree() : problem(Scheme::kRadau2, "planar"), tree(problem.ocp->model) {
    const int n = tree.size();
    q = VectorX::LinSpaced(n, -0.5, 0.7);
    v = VectorX::LinSpaced(n, 1, -1);
    a = VectorX::LinSpaced(n, 3, 2);
    tau.resize(n);
    lambda = VectorX::Ones(n);
    dq = dv = da = qq = qv = qa = vv = MatrixX::Zero(n, n);
    tree.Update(q.data(), v.data(), a.data(), problem.ocp->gravity);
  }
  Problem problem;
  TreeDynamics tree;
  VectorX q, v, a, tau, lambda;
  MatrixX dq, dv, da, qq, qv, qa, vv;
};

void InverseDynamics9(benchmark::State& state) {
  Tree t;
  for ([[maybe_unused]] auto _ : state) {
    t.tree.Update(t.q.data(), t.v.data(), t.a.data(), t.problem.ocp->gravity);
    t.tree.InverseDynamics(t.tau.data());
    benchmark::DoNotOptimize(t.tau.data());
  }
}
void FirstDerivatives9(benchmark::State& state) {
  Tree t;
  for ([[maybe_unused]] auto _ : state) {
    t.tree.FirstDerivatives(t.dq, t.dv, t.da);
    benchmark::DoNotOptimize(t.dq.data());
  }
}
void ContractedHessian9(benchmark::State& state) {
  Tree t;
  for ([[maybe_unused]] auto _ : state) {
    t.tree.AddContractedHessian(t.lambda.data(), t.qq, t.qv, t.qa, t.vv);
    benchmark::DoNotOptimize(t.qq.data());
  }
}
BENCHMARK(InverseDynamics9);
BENCHMARK(FirstDerivatives9);
BENCHMARK(ContractedHessian9);

}  // namespace
}  // namespace rollgait

BENCHMARK_MAIN();
