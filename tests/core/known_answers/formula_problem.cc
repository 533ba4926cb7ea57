#include "tests/core/known_answers/formula_problem.h"

#include <string>
#include <utility>

namespace rollgait {

std::unique_ptr<OptimalControlProblem> CoordinatesWithFormula(const std::vector<Coordinate>& coordinates,
                                                              FormulaOfMotion::Accelerations f) {
  std::vector<Joint> joints;
  for (const Coordinate& coordinate : coordinates) {
    Joint& joint = joints.emplace_back();
    joint.name = "coordinate_" + std::to_string(joints.size() - 1);
    joint.link = joint.name + "_link";
    joint.type = JointType::kPrismatic;
    joint.axis = Vector3::UnitX();
    joint.mass = 1;  // without meaning
    joint.position_min = coordinate.position.min;
    joint.position_max = coordinate.position.max;
    joint.actuated = coordinate.controlled;
    if (joint.actuated) joint.effort_min = coordinate.control.min, joint.effort_max = coordinate.control.max;
  }
  auto problem = std::make_unique<OptimalControlProblem>(Model::Create(joints).value());
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
                          std::vector<double> controls) {
  double total = 0, time = 0;
  for (const double duration : durations) total += duration;
  std::vector<std::vector<double>> states{start};
  for (const double duration : durations) {
    time += duration;
    std::vector<double>& state = states.emplace_back(start);
    for (size_t i = 0; i < state.size(); ++i) state[i] += time / total * (end[i] - start[i]);
  }
  const size_t phases = durations.size();
  return PiecewiseGuess(std::move(durations), std::move(states), std::vector<std::vector<double>>(phases, controls));
}

MotionGuess PiecewiseGuess(std::vector<double> durations, std::vector<std::vector<double>> states,
                           std::vector<std::vector<double>> controls) {
  MotionGuess guess;
  guess.durations = durations;
  guess.motion = [=](int phase, double fraction) {
    const auto vector = [](const std::vector<double>& values) {
      return VectorX(Eigen::Map<const VectorX>(values.data(), static_cast<Eigen::Index>(values.size())));
    };
    const size_t p = static_cast<size_t>(phase);
    const VectorX a = vector(states[p]), b = vector(states[p + 1]), state = a + fraction * (b - a);
    const Eigen::Index n = state.size() / 2;
    return MotionSample{state.head(n), state.tail(n), (b - a).tail(n) / durations[p], vector(controls[p]), VectorX(0)};
  };
  return guess;
}

}  // namespace rollgait
