#include "tests/core/known_answers/known_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/nlp/interior_point.h"

namespace rollgait {
namespace {

// Part of an objective that the solver's tolerance and rounding leave open.
constexpr double kRounding = 2e-11;

const char* NameOf(Scheme scheme) {
  switch (scheme) {
    case Scheme::kRadau2:
      return "Radau IIA, 2 points";
    case Scheme::kRadau3:
      return "Radau IIA, 3 points";
    case Scheme::kHermiteSimpson:
      return "Hermite-Simpson";
  }
  return "";
}

int OrderOf(Scheme scheme) {
  switch (scheme) {
    case Scheme::kRadau2:
      return 3;
    case Scheme::kRadau3:
      return 5;
    case Scheme::kHermiteSimpson:
      return 4;
  }
  return 0;
}

std::vector<Joint> UnboundedCoordinates(int n, int efforts) {
  std::vector<Joint> joints(static_cast<size_t>(n));
  for (int j = 0; j < n; ++j) {
    Joint& joint = joints[static_cast<size_t>(j)];
    joint.name = "coordinate_" + std::to_string(j);
    joint.link = joint.name + "_link";
    joint.type = JointType::kPrismatic;
    joint.axis = Vector3::UnitX();
    joint.mass = 1;  // without meaning
    joint.actuated = j < efforts;
    if (joint.actuated) joint.effort_min = -kInfinity, joint.effort_max = kInfinity;
  }
  return joints;
}

}  // namespace

std::unique_ptr<OptimalControlProblem> CoordinatesWithFormula(int n, int efforts, FormulaOfMotion::Accelerations f) {
  auto problem = std::make_unique<OptimalControlProblem>(Model::Create(UnboundedCoordinates(n, efforts)).value());
  problem->gravity = Vector3(0, 0, -1 / problem->model.total_mass());  // sizes of 1
  problem->lever = 1;
  problem->phases.push_back({{}, {}});
  problem->mirrored = false;
  problem->denominator = CostDenominator::kNothing;
  problem->equations_of_motion = [f = std::move(f)](const PointLayout& layout) {
    return std::make_unique<FormulaOfMotion>(layout, f);
  };
  return problem;
}

void AddCost(OptimalControlProblem* problem, double typical, FormulaCost::Integrand integrand) {
  CostDescription cost;
  cost.term = std::make_unique<FormulaCost>(problem->Layout(0), typical, std::move(integrand));
  problem->costs.push_back(std::move(cost));
}

void PrescribeEnds(OptimalControlProblem* problem, const std::vector<double>& start, const std::vector<double>& end) {
  const auto bounds = [](const std::vector<double>& at) {
    EndBounds end_bounds;
    end_bounds.lower = end_bounds.upper = Eigen::Map<const VectorX>(at.data(), static_cast<Eigen::Index>(at.size()));
    for (double& value : end_bounds.lower) value = value == kFree ? -kInfinity : value;
    return end_bounds;
  };
  problem->ends = Ends{bounds(start), bounds(end)};
}

MotionGuess StraightGuess(std::vector<double> durations, std::vector<double> start, std::vector<double> end,
                          std::vector<double> efforts) {
  double total = 0;
  for (double duration : durations) total += duration;
  MotionGuess guess;
  guess.durations = durations;
  guess.motion = [=](int phase, double fraction) {
    double time = fraction * durations[static_cast<size_t>(phase)];
    for (int p = 0; p < phase; ++p) time += durations[static_cast<size_t>(p)];
    const int n = static_cast<int>(start.size()) / 2;
    const VectorX a = Eigen::Map<const VectorX>(start.data(), 2 * n), b = Eigen::Map<const VectorX>(end.data(), 2 * n);
    const VectorX state = a + time / total * (b - a);
    MotionSample sample{state.head(n), state.tail(n), (b - a).tail(n) / total, VectorX(), VectorX(0)};
    sample.efforts = Eigen::Map<const VectorX>(efforts.data(), static_cast<Eigen::Index>(efforts.size()));
    return sample;
  };
  return guess;
}

Computed SolveOnce(const KnownProblem& known, Scheme scheme, const Mesh& mesh, const MotionGuess& guess) {
  CollocationNlp nlp(*known.problem, scheme, mesh);
  NlpOptions options;
  options.tolerance = 1e-10;
  const InteriorPointResult solved = SolveWithInteriorPoint(nlp, {nlp.MakeStart(guess), {}, {}, {}}, options, {});
  const NlpResult& result = solved.result;
  EXPECT_FALSE(solved.needs_restoration);
  EXPECT_EQ(result.termination, Termination::kOptimal) << result.message << ", " << result.iterations << " iterations";
  const VectorX integrals = nlp.CostIntegrals(result.x.data());
  double objective = 0;
  for (size_t t = 0; t < known.problem->costs.size(); ++t) {
    objective += known.problem->costs[t].weight * integrals(static_cast<int>(t));
  }
  objective /= nlp.Denominator(result.x.data());
  return {objective, result.iterations, result.wall_time_s, nlp.Extract(result.x.data())};
}

Computed ExpectKnownAnswer(const KnownProblem& known, Scheme scheme, const Mesh& mesh) {
  const KnownAnswer& answer = known.answer;
  Computed coarse = SolveOnce(known, scheme, mesh, known.guess);
  const Computed fine = SolveOnce(known, scheme, Halved(mesh), GuessFromTrajectory(coarse.trajectory));
  const double size = std::abs(answer.objective), error = std::abs(coarse.objective - answer.objective);
  const double powers = std::pow(2, OrderOf(scheme));
  const double bar = std::abs(coarse.objective - fine.objective) * powers / (powers - 1) + kRounding * size;
  int intervals = 0;
  for (const auto& phase : mesh.fractions) intervals += static_cast<int>(phase.size());
  std::printf("| %s | %s, %d | %.0e | %.1e | %.1e | %.12g | %d |\n", answer.problem.c_str(), NameOf(scheme), intervals,
              answer.asked, error / size, bar / size, coarse.objective, coarse.iterations);
  EXPECT_LE(error, answer.asked * size + answer.uncertainty) << answer.problem << ": " << coarse.objective;
  EXPECT_LE(error, bar + answer.uncertainty) << answer.problem << ": " << coarse.objective;
  EXPECT_LE(bar, answer.asked * size) << answer.problem << ": the bar is wider than what was asked";
  return coarse;
}

}  // namespace rollgait
