// Time of one evaluation of the planar NLP per collocation point: constraints, Jacobian, Hessian, and the dynamics kernels.
//   nlp_evaluation [--benchmark_...]   (Google Benchmark; one thread; Release)

#include <benchmark/benchmark.h>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"

namespace rollgait {
namespace {

struct Problem {
  explicit Problem(Scheme scheme) {
    GaitRequest request;
    request.body.model = "planar";
    request.motion.speed = 1.3;
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
  std::unique_ptr<GaitSpec> spec;
  std::unique_ptr<OptimalControlProblem> ocp;
  std::unique_ptr<CollocationNlp> nlp;
  VectorX x, lambda, g, jacobian, hessian;
  int points;
};

void PerPoint(benchmark::State& state, int points) {
  state.counters["ns_per_point"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * points * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void Constraints(benchmark::State& state) {
  Problem p(static_cast<Scheme>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(p.nlp->Constraints(p.x.data(), p.g.data()));
  PerPoint(state, p.points);
}
void Jacobian(benchmark::State& state) {
  Problem p(static_cast<Scheme>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(p.nlp->Jacobian(p.x.data(), p.jacobian.data()));
  PerPoint(state, p.points);
}
void Hessian(benchmark::State& state) {
  Problem p(static_cast<Scheme>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(p.nlp->Hessian(p.x.data(), 1, p.lambda.data(), p.hessian.data()));
  PerPoint(state, p.points);
}
// One evaluation as a solver's iteration needs it.
void AllThree(benchmark::State& state) {
  Problem p(static_cast<Scheme>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(p.nlp->Constraints(p.x.data(), p.g.data()));
    benchmark::DoNotOptimize(
        p.nlp->Derivatives(p.x.data(), 1, p.lambda.data(), p.jacobian.data(), p.hessian.data()));
  }
  PerPoint(state, p.points);
}
BENCHMARK(Constraints)->DenseRange(0, 2);
BENCHMARK(Jacobian)->DenseRange(0, 2);
BENCHMARK(Hessian)->DenseRange(0, 2);
BENCHMARK(AllThree)->DenseRange(0, 2);

struct Tree {
  Tree() : problem(Scheme::kRadau2), tree(problem.ocp->model) {
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
  for (auto _ : state) {
    t.tree.Update(t.q.data(), t.v.data(), t.a.data(), t.problem.ocp->gravity);
    t.tree.InverseDynamics(t.tau.data());
    benchmark::DoNotOptimize(t.tau.data());
  }
}
void FirstDerivatives9(benchmark::State& state) {
  Tree t;
  for (auto _ : state) {
    t.tree.FirstDerivatives(t.dq, t.dv, t.da);
    benchmark::DoNotOptimize(t.dq.data());
  }
}
void ContractedHessian9(benchmark::State& state) {
  Tree t;
  for (auto _ : state) {
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
