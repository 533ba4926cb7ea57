#include "core/transcription/linear_rows.h"

#include "core/transcription/consecutive_points.h"

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
  const int blocks = layout.jumps(0) ? 1 : 2;  // the velocities at the start are what a jump makes of those at the end
  for (int block = 0; block < blocks; ++block) {
    for (int j = 0; j < n; ++j) {
      const Joint& joint = problem.model.joint(j);
      const int source = problem.mirrored && joint.mirror_joint >= 0 ? joint.mirror_joint : j;
      const double sign = problem.mirrored ? joint.mirror_sign : 1;
      LinearRows::Row row;
      row.name = "periodicity " + joint.name;
      row.unit = std::string(joint.kind().unit()) + (block == 0 ? "" : "/s");
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
  rows->Add(
      {"displacement",
       "m",
       0,
       0,
       {{layout.node(layout.intervals()) + joint, 1.0}, {layout.node(0) + joint, -1.0}, {layout.displacement(), -1.0}},
       1});
}

void AddJumpPositionRows(const OptimalControlProblem& problem, const DecisionLayout& layout, LinearRows* rows) {
  for (int p = 1; p < layout.phases(); ++p) {
    if (!layout.jumps(p)) continue;
    for (int j = 0; j < problem.model.size(); ++j) {
      const Joint& joint = problem.model.joint(j);
      rows->Add({"position at touch-down " + joint.name,
                 joint.kind().unit(),
                 0,
                 0,
                 {{layout.node(layout.first_interval(p)) + j, 1.0},
                  {layout.end_node(layout.first_interval(p) - 1) + j, -1.0}},
                 1});
    }
  }
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

void AddContinuityRows(const OptimalControlProblem& problem, const DecisionLayout& layout,
                       const EliminatedScheme& scheme, LinearRows* rows) {
  bool efforts = false, forces = false;
  for (const CostDescription& cost : problem.costs) {
    if (cost.weight <= 0) continue;
    efforts |= cost.IsRateOf(RateCost::Of::kEfforts);
    forces |= cost.IsRateOf(RateCost::Of::kForces);
  }
  const auto add = [rows](const std::string& name, const char* unit, Change change, double size) {
    for (auto& [unknown, coefficient] : change.terms) coefficient /= size;
    rows->Add({name, unit, 0, 0, std::move(change.terms), size});
  };
  for (const PointLink& link : ConsecutivePoints(layout, scheme.tableau().c)) {
    if (link.ratio != 0) continue;
    const bool changes_contacts = link.wraps || layout.phase(link.from_interval) != link.phase;
    const bool is_constant = problem.phases[link.phase].effort_degree == 0;
    if (efforts || (scheme.tableau().joins_efforts() && !changes_contacts && !is_constant)) {
      const std::vector<Change> changes = EffortChanges(problem, layout, link);
      for (size_t j = 0; j < changes.size(); ++j) {
        add("continuous effort " + problem.model.joint(problem.model.actuated()[j]).name, "N m", changes[j],
            problem.effort_size());
      }
    }
    // Where contacts change, forces do.
    if (!forces || changes_contacts) continue;
    for (auto& [name, change] : ForceChanges(problem, layout, link)) {
      add("continuous force " + name, "N", std::move(change), problem.force_size());
    }
  }
}

}  // namespace rollgait
