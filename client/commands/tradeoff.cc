#include "client/commands/tradeoff.h"

#include <algorithm>
#include <tuple>

#include "client/commands/follow.h"
#include "client/commands/tradeoff_result.h"
#include "client/sweep/batches.h"
#include "client/sweep/folder.h"
#include "client/sweep/leave.h"
#include "client/sweep/request_digest.h"
#include "client/sweep/solve_group.h"
#include "client/text.h"
#include "client/tradeoff/solve_row.h"

namespace rollgait::client {
namespace {

constexpr char kLabel[] = "tradeoff";
// Of the reference, of the mesh before it, and of what leads to minima. With 1e-8 a Radau-3 mesh of 256 intervals ends
// where rounding does, at 8e-7, after hundreds of iterations.
constexpr double kReferenceTolerance = 1e-6;
constexpr int kReferenceHalvings = 2;

// Whether the solver came from the start it was given to a solution.
bool IsReached(const v1::Solve& solve) {
  return solve.state() == v1::SOLVE_STATE_SUCCEEDED && solve.result().has_trajectory() &&
         solve.result().has_warm_started_from() && solve.result().termination() == v1::TERMINATION_OPTIMAL;
}

// Makes solves, or attaches to those that the same command made, and follows them to their ends.
class Solver {
 public:
  Solver(Connection& connection, Progress& progress, Leave& leave, double reconnect_s, std::string name)
      : connection_(connection),
        progress_(progress),
        leave_(leave),
        reconnect_s_(reconnect_s),
        name_(std::move(name)) {}

  // The finished solves, in the order of the requests.
  std::vector<v1::Solve> Solve(const std::vector<v1::SolveSpec>& specs, const std::string& what) {
    std::vector<v1::CreateSolveRequest> requests(specs.size());
    for (size_t i = 0; i < specs.size(); ++i) {
      *requests[i].mutable_spec() = specs[i];
      (*requests[i].mutable_labels())[kLabel] = name_;
      requests[i].set_request_id("tradeoff-" + Digest(name_ + "\n" + Digest(BytesOf(specs[i]))));
    }
    std::vector<v1::Solve> solves =
        CreateInBatches(connection_, requests, [this](double seconds) { leave_.Wait(seconds); });
    size_t done = 0;
    const auto on_event = [&](size_t place, const v1::SolveEvent& event) {
      if (!event.has_finished()) return;
      solves[place] = event.finished();
      progress_.Note(what + " " + std::to_string(++done) + "/" + std::to_string(specs.size()) + ": " +
                     event.finished().name() + " " + StateName(event.finished().state()));
    };
    FollowAll(connection_, std::vector<v1::Solve>(solves), reconnect_s_, leave_, on_event,
              [this](const std::string& note) { progress_.Note(note); });
    return solves;
  }

 private:
  Connection& connection_;
  Progress& progress_;
  Leave& leave_;
  const double reconnect_s_;
  const std::string name_;
};

// The finest of the optimal points: of the highest order, then of most intervals, then of the least tolerance.
const SolveRow* FinestOf(const std::vector<SolveRow>& rows) {
  const auto rank = [](const SolveRow& row) {
    return std::tuple(OrderOf(row.point.scheme), row.point.intervals, -row.point.tolerance);
  };
  const SolveRow* finest = nullptr;
  for (const SolveRow& row : rows) {
    if (row.is_optimal && (finest == nullptr || rank(*finest) < rank(row))) finest = &row;
  }
  return finest;
}

// The request of `from` on another mesh, from the solution `name`.
v1::SolveSpec Continued(const v1::SolveSpec& task, const TradeoffPoint& from, const TradeoffPoint& to,
                        const std::string& name) {
  v1::SolveSpec spec = SpecOfPoint(task, {from.scheme, to.intervals, std::min(to.tolerance, from.tolerance)});
  spec.set_warm_start(name);
  return spec;
}

// The last two meshes of the reference, the finest last; empty if a step from one to the next fails.
std::vector<v1::Solve> SolveReference(Solver& solver, const v1::SolveSpec& task, const SolveRow& finest) {
  std::vector<v1::Solve> steps;
  std::string from = finest.solve.name();
  TradeoffPoint to = finest.point;
  for (int i = 1; i <= kReferenceHalvings; ++i) {
    to.intervals *= 2;
    to.tolerance = kReferenceTolerance;
    steps.push_back(solver.Solve({Continued(task, finest.point, to, from)}, "reference").front());
    if (!IsReached(steps.back())) return {};
    from = steps.back().name();
  }
  return steps;
}

// Follows the points that are far from the reference to the reference's mesh.
void FindMinima(Solver& solver, const v1::SolveSpec& task, const v1::SolveResult& reference, int intervals,
                std::vector<SolveRow>& rows) {
  std::vector<v1::SolveSpec> specs;
  std::vector<SolveRow*> far;
  for (SolveRow& row : rows) {
    if (!row.errors) continue;
    row.minimum = MinimumOf(row.errors->angle_deg, std::nullopt);
    if (row.errors->angle_deg <= kFarAngle_deg) continue;
    specs.push_back(Continued(task, row.point, {row.point.scheme, intervals, kReferenceTolerance}, row.solve.name()));
    far.push_back(&row);
  }
  if (specs.empty()) return;
  const std::vector<v1::Solve> solves = solver.Solve(specs, "far point");
  for (size_t i = 0; i < far.size(); ++i) {
    if (!IsReached(solves[i])) continue;
    const double followed_deg = ErrorsAgainst(reference, solves[i].result()).angle_deg;
    far[i]->minimum = MinimumOf(far[i]->errors->angle_deg, followed_deg);
  }
}

// A mesh that misses the bounds of the request is no failure here: how far it is off is what is measured.
ExitCode FirstFailure(const std::vector<v1::Solve>& solves) {
  for (const v1::Solve& solve : solves) {
    const ExitCode code = ExitCodeOf(solve);
    if (code != ExitCode::kSuccess && code != ExitCode::kMissesBound) return code;
  }
  return ExitCode::kSuccess;
}

}  // namespace

ExitCode RunTradeoff(const TradeoffOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!options.scene.file.empty()) return RunSceneTradeoff(options, global, terminal);
  const v1::SolveSpec task = BuildSpec(options.spec);
  const auto points = MakeTradeoffPoints(options.schemes, options.intervals, options.tolerances.value_or("1e-6"));
  std::vector<v1::SolveSpec> specs, estimating;
  std::string all;
  for (const TradeoffPoint& point : points) {
    specs.push_back(SpecOfPoint(task, point));
    estimating.push_back(specs.back());
    estimating.back().mutable_accuracy()->set_estimate_errors(true);
    all += Digest(BytesOf(specs.back()));
  }
  const std::string name = Digest(all);
  if (!options.output.empty()) MakeFolder("--output", options.output);

  Progress progress(terminal, global.json || global.quiet ? Progress::Style::kSilent : ProgressStyle(global, terminal));
  Leave leave(progress);
  Connection connection(global);
  Solver solver(connection, progress, leave, options.reconnect_s, name);
  const std::vector<v1::Solve> solves = solver.Solve(specs, "point");
  std::vector<SolveRow> rows;
  for (size_t i = 0; i < points.size(); ++i) rows.push_back(RowOfPoint(points[i], solves[i]));
  if (options.estimate_errors) {
    const std::vector<v1::Solve> twins = solver.Solve(estimating, "estimate");
    for (size_t i = 0; i < rows.size(); ++i) rows[i].estimated = EstimateOf(twins[i].result());
  }
  const SolveRow* const finest = FinestOf(rows);
  std::vector<v1::Solve> reference;
  if (finest != nullptr) reference = SolveReference(solver, task, *finest);
  if (!reference.empty()) {
    const v1::SolveResult& truth = reference.back().result();
    const double apart_deg = ErrorsAgainst(truth, reference.front().result()).angle_deg;
    for (size_t i = 0; i < rows.size(); ++i) {
      if (!rows[i].is_optimal) continue;
      rows[i].errors = ErrorsAgainst(truth, solves[i].result());
      rows[i].is_well_known = IsWellKnown(rows[i].errors->angle_deg, apart_deg);
    }
    FindMinima(solver, task, truth, finest->point.intervals << kReferenceHalvings, rows);
  }
  progress.End();
  WriteTradeoff(SolveTable(name, reference.empty() ? "" : reference.back().name(), rows), options.output, global,
                terminal);
  if (reference.empty()) {
    throw Failure(ExitCode::kNoSolution,
                  finest == nullptr ? "tradeoff: no point is optimal, so there is no reference and no error is known"
                                    : "tradeoff: the reference was not reached from " + finest->solve.name() +
                                          ", so no error is known; try a finer mesh in --intervals");
  }
  return FirstFailure(solves);
}

}  // namespace rollgait::client
