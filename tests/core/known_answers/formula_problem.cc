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
    sample.efforts = Eigen::Map<const VectorX>(controls.data(), static_cast<Eigen::Index>(controls.size()));
    return sample;
  };
  return guess;
}

}  // namespace rollgait
