#include "core/transcription/linear_rows.h"

#include "core/transcription/effort_rate_term.h"

namespace rollgait {

void LinearRows::Bounds(double* lower, double* upper) const {
  for (const Row& row : rows_) {
    *lower++ = row.lower;
    *upper++ = row.upper;
  }
}

void LinearRows::AddPattern(int first_row, SparsityPattern* jacobian) const {
  for (const Row& row : rows_) {
    for (const auto& [unknown, coefficient] : row.terms) jacobian->Add(first_row, unknown);
    ++first_row;
  }
}

void LinearRows::Values(const double* x, double* g) const {
  for (const Row& row : rows_) {
    double sum = 0;
    for (const auto& [unknown, coefficient] : row.terms) sum += coefficient * x[unknown];
    *g++ = sum;
  }
}

void LinearRows::Jacobian(double* values) const {
  for (const Row& row : rows_) {
    for (const auto& [unknown, coefficient] : row.terms) *values++ = coefficient;
  }
}

void AddPeriodicityRows(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows) {
  const int n = problem.model.size();
  for (int block = 0; block < 2; ++block) {
    for (int j = 0; j < n; ++j) {
      const Joint& joint = problem.model.joint(j);
      const int source = problem.mirrored && joint.mirror_joint >= 0 ? joint.mirror_joint : j;
      const double sign = problem.mirrored ? joint.mirror_sign : 1;
      LinearRows::Row row;
      row.name = "periodicity " + joint.name;
      row.unit = std::string(joint.type == JointType::kPrismatic ? "m" : "rad") + (block == 0 ? "" : "/s");
      row.terms.emplace_back(layout.node(layout.intervals()) + block * n + j, 1.0);
      row.terms.emplace_back(layout.node(0) + block * n + source, -sign);
      if (block == 0 && j == problem.forward_joint) row.terms.emplace_back(layout.displacement(), -1.0);
      rows->Add(std::move(row));
    }
  }
}

void AddDisplacementRow(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows) {
  if (problem.displacement.min == problem.displacement.max) return;  // the ends prescribe it
  const int joint = problem.forward_joint;
  rows->Add({"displacement", "m", 0, 0,
             {{layout.node(layout.intervals()) + joint, 1.0}, {layout.node(0) + joint, -1.0}, {layout.displacement(), -1.0}},
             1});
}

void AddTravelRows(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows) {
  const auto durations = [&layout](double coefficient) {
    std::vector<std::pair<int, double>> terms;
    for (int p = 0; p < layout.phases(); ++p) terms.emplace_back(layout.duration(p), coefficient);
    return terms;
  };
  const auto add_speed = [&](double speed, double lower, double upper) {
    LinearRows::Row row{"speed", "m", lower, upper, durations(-speed), 1};
    row.terms.emplace_back(layout.displacement(), 1.0);
    rows->Add(std::move(row));
  };
  if (problem.speed.min == problem.speed.max) {
    add_speed(problem.speed.min, 0, 0);
  } else {
    if (problem.speed.min > -kInfinity) add_speed(problem.speed.min, 0, kInfinity);
    if (problem.speed.max < kInfinity) add_speed(problem.speed.max, -kInfinity, 0);
  }
  if (problem.duty_factor) {
    const auto add_duty = [&](double duty, double lower, double upper) {
      LinearRows::Row row{"duty factor", "s", lower, upper, {}, 1};
      for (int p = 0; p < layout.phases(); ++p) {
        row.terms.emplace_back(layout.duration(p), 0.5 * problem.StandingFeet(p) - duty);
      }
      rows->Add(std::move(row));
    };
    const Interval& duty = *problem.duty_factor;
    if (duty.min == duty.max) {
      add_duty(duty.min, 0, 0);
    } else {
      add_duty(duty.min, 0, kInfinity);
      add_duty(duty.max, -kInfinity, 0);
    }
  }
  if (problem.duration.min > -kInfinity || problem.duration.max < kInfinity) {
    rows->Add({"step duration", "s", problem.duration.min, problem.duration.max, durations(1), 1});
  }
}

void AddEffortContinuityRows(const OptimalControlProblem& problem, const DecisionLayout& layout,
                             const EliminatedScheme& scheme, LinearRows* rows) {
  bool rate_costs = false;
  for (const CostDescription& cost : problem.costs) {
    rate_costs |= cost.weight > 0 && std::holds_alternative<EffortRateCost>(cost.term);
  }
  if (!rate_costs) return;
  for (const EffortLink& link : ConsecutiveEfforts(problem, layout, scheme.tableau().c)) {
    if (link.ratio != 0) continue;
    for (size_t j = 0; j < link.from.size(); ++j) {
      const std::string& name = problem.model.joint(problem.model.actuated()[j]).name;
      rows->Add({"continuous effort " + name, "N m", 0, 0, {{link.from[j], 1.0}, {link.to[j], -link.sign[j]}},
                 problem.effort_size()});
    }
  }
}

}  // namespace rollgait
