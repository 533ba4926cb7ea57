#include "client/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/accuracy_table.h"
#include "client/failure.h"
#include "client/gait_events_table.h"
#include "client/normative_table.h"
#include "client/report/rolling_path.h"
#include "client/terminal.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string Section(const std::string& title, const Rows& rows, const std::string& alignment, bool color) {
  return rows.empty() ? "" : "\n" + Paint(title, Tone::kBold, color) + "\n" + FormatTable(rows, alignment);
}

Rows GaitRows(const v1::Solve& solve) {
  const v1::SolveResult& result = solve.result();
  const v1::Trajectory& trajectory = result.trajectory();
  Rows rows = {{"  slope", FormatNumber(solve.spec().slope_rad() * 180 / kPi), "°"},
               {"  speed", FormatNumber(result.speed_m_s()), "m/s"},
               {trajectory.cycle() == v1::CYCLE_FULL ? "  step length, mean of both feet" : "  step length",
                FormatNumber(result.step_length_m()), "m"}};
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    const double share = trajectory.duration_s() > 0 ? 100 * phase.duration_s() / trajectory.duration_s() : 0;
    rows.push_back({"  " + PhaseName(phase), FormatNumber(phase.duration_s()),
                    "s (" + FormatNumber(share, 3) + " % of the " +
                        (trajectory.cycle() == v1::CYCLE_FULL ? "cycle" : "half cycle") + ")"});
  }
  return rows;
}

Rows ManoeuvreRows(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = solve.result().trajectory();
  const v1::Manoeuvre::State &start = solve.spec().manoeuvre().start(), &end = solve.spec().manoeuvre().end();
  const auto place = [](const v1::Manoeuvre::State& state, bool free) {
    const auto number = [&](bool given, double value) { return free && !given ? "free" : FormatNumber(value); };
    return "(" + number(state.has_x_m(), state.x_m()) + ", " + number(state.has_y_m(), state.y_m()) + ")";
  };
  Rows rows = {{"  slope", FormatNumber(solve.spec().slope_rad() * 180 / kPi), "°"},
               {"  from", place(start, false), "m"},
               {"  to", place(end, true), std::string("m, orientation ") + (end.has_orientation() ? "given" : "free")},
               {"  duration", FormatNumber(trajectory.duration_s()), "s"}};
  double length = 0, couple = 0;
  const RollingPath path = BuildRollingPath(trajectory, solve.result().model());
  for (size_t k = 0; k < path.samples.size(); ++k) {
    const RollingPath::Sample& at = path.samples[k];
    couple = std::max(couple, at.couple_n_m);
    if (k == 0) continue;
    length +=
        std::hypot(at.contact_x_m - path.samples[k - 1].contact_x_m, at.contact_y_m - path.samples[k - 1].contact_y_m);
  }
  rows.push_back({"  path of the contact point", FormatNumber(length), "m"});
  rows.push_back({"  largest couple", FormatNumber(couple), "N m"});
  return rows;
}

Rows CostRows(const v1::SolveResult& result) {
  Rows rows;
  for (const v1::CostValue& cost : result.costs()) {
    rows.push_back({"  " + cost.name(), FormatNumber(cost.value(), 6), cost.unit(),
                    "weight " + FormatNumber(cost.weight()), "adds " + FormatNumber(cost.contribution(), 6)});
    if (cost.has_unsmoothed_value() && cost.unsmoothed_value() != cost.value()) {
      rows.push_back({"    without smoothing", FormatNumber(cost.unsmoothed_value(), 6), cost.unit()});
    }
  }
  rows.push_back({"  objective", FormatNumber(result.objective(), 8)});
  return rows;
}

Rows AccuracyRows(const v1::Solve& solve, bool color) {
  Rows rows;
  for (const AccuracyLine& line : AccuracyLines(solve)) {
    std::string bound;
    if (line.bound) {
      bound = Paint(line.exceeded ? "exceeds " : "≤ ", line.exceeded ? Tone::kBad : Tone::kGood, color) +
              FormatNumber(*line.bound);
    }
    std::string note = bound + (bound.empty() || line.where.empty() ? "" : "; ") + line.where;
    rows.push_back({"  " + line.name, FormatNumber(line.value, 3), line.unit, note});
  }
  return rows;
}

Rows UnmetRows(const v1::SolveResult& result) {
  Rows rows;
  for (const v1::UnmetConstraint& unmet : result.unmet_constraints()) {
    rows.push_back({"  " + unmet.name(), "by " + FormatNumber(unmet.violation()) + " " + unmet.unit(),
                    "phase " + std::to_string(unmet.phase()) + " at " + FormatNumber(unmet.time_s(), 3) + " s"});
  }
  return rows;
}

std::string StartNote(const v1::SolveResult& result) {
  if (!result.has_warm_started_from()) return "";
  const v1::WarmStartSource& source = result.warm_started_from();
  constexpr double kConstraintTolerance = 1e-6;  // to which the speed of a result is that of its request
  const double speed = source.speed_difference_m_s();
  return "; started from " + source.name() + ", " + FormatVisible(source.slope_difference_rad() * 180 / kPi, 1e-9) +
         "° and " + FormatVisible(speed, kConstraintTolerance) + " m/s away" +
         (source.used_multipliers() ? "" : ", without its multipliers");
}

std::string EffortLine(const v1::Solve& solve) {
  const v1::SolveResult& result = solve.result();
  int iterations = 0;
  for (const v1::MeshStatistics& mesh : result.meshes()) iterations += mesh.iterations();
  return "\n" + std::to_string(iterations) + " iterations on " + std::to_string(result.meshes_size()) +
         (result.meshes_size() == 1 ? " mesh, " : " meshes, ") + FormatDuration(result.wall_time_s()) + " wall, " +
         FormatDuration(result.cpu_time_s()) + " CPU, " +
         FormatNumber(static_cast<double>(result.peak_memory_bytes()) / 1048576.0, 3) + " MiB" + StartNote(result) +
         (solve.from_cache() ? "; answered from an earlier, equal request" : "") + "\n";
}

}  // namespace

std::string Verdict(const v1::Solve& solve) {
  switch (solve.state()) {
    case v1::SOLVE_STATE_SUCCEEDED:
      return TerminationName(solve.result().termination()) +
             (HasSolution(solve) ? ", accuracy " + AccuracyVerdict(solve) : "") +
             (solve.result().message().empty() ? "" : ": " + solve.result().message());
    case v1::SOLVE_STATE_FAILED:
      return "failed (" + ErrorKindName(solve.error().kind()) + "): " + solve.error().message();
    case v1::SOLVE_STATE_CANCELLED:
      return "cancelled" + (solve.error().message().empty() ? "" : ": " + solve.error().message());
    default:
      return StateName(solve.state());
  }
}

std::string Summarize(const v1::Solve& solve, bool color) {
  const bool good = ExitCodeOf(solve) == ExitCode::kSuccess;
  const bool open = solve.state() == v1::SOLVE_STATE_QUEUED || solve.state() == v1::SOLVE_STATE_RUNNING;
  const Tone tone = good ? Tone::kGood : open ? Tone::kPlain : Tone::kBad;
  std::string text = Paint(solve.name(), Tone::kBold, color) + "  " + Paint(Verdict(solve), tone, color) + "\n";
  if (!solve.has_result()) return text;
  const v1::SolveResult& result = solve.result();
  text += Section("Constraints that are not met", UnmetRows(result), "l", color);
  if (result.has_trajectory()) {
    text += solve.spec().has_manoeuvre() ? Section("Manoeuvre", ManoeuvreRows(solve), "lr", color)
                                         : Section("Gait", GaitRows(solve), "lr", color);
    text += Section("Gait cycle from right heel strike, %", GaitEventRows(result.gait_events()), "lr", color);
    text += Section("Cost", CostRows(result), "lr", color);
  }
  if (result.has_accuracy()) {
    text += Section("Accuracy: " + AccuracyVerdict(solve), AccuracyRows(solve, color), "lr", color);
  }
  text += Section("Right leg beside normative gait (level ground)", NormativeRows(result.normative()), "lrrr", color);
  text +=
      Section("Left leg beside normative gait (level ground)", NormativeRows(result.normative_left()), "lrrr", color);
  return text + EffortLine(solve);
}

}  // namespace rollgait::client
