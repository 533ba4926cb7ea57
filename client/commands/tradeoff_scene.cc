#include <grpcpp/client_context.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>

#include "client/commands/follow.h"
#include "client/commands/tradeoff.h"
#include "client/commands/tradeoff_result.h"
#include "client/interrupt.h"
#include "client/json.h"
#include "client/simulation_end.h"
#include "client/sweep/folder.h"
#include "client/sweep/request_digest.h"
#include "client/text.h"
#include "client/tradeoff/scene_row.h"

namespace rollgait::client {
namespace {

// The reference's own error is about a tenth of the finest point's, and that of this one about a third of it.
constexpr double kBeforeReference = 0.31622776601683794;

constexpr int kMostWithoutTime = 20;  // runs of a point

// Simulates on the server until Ctrl-C. Made before the first gRPC object of the process.
class Simulator {
 public:
  explicit Simulator(const TradeoffOptions& options)
      : max_wall_time_s_(options.max_wall_time_s), interrupt_([this](int) { Stop(); }) {}

  // Waits where the server has no place for another simulation. Throws the Failure of a call that did not end well,
  // kCancelled after Ctrl-C.
  v1::Simulation Run(Connection& connection, const v1::SimulationScene& scene) {
    for (;;) {
      v1::Simulation whole;
      const grpc::Status status = Try(connection, scene, whole);
      if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED && RetryDelay(status)) {
        Wait(*RetryDelay(status));
        continue;
      }
      RequireOk(status, "simulate the scene", connection.server(), CallKind::kScene);
      return whole;
    }
  }

 private:
  grpc::Status Try(Connection& connection, const v1::SimulationScene& scene, v1::Simulation& whole) {
    v1::SimulateRequest request;
    *request.mutable_scene() = scene;
    if (max_wall_time_s_) request.set_max_wall_time_s(*max_wall_time_s_);
    grpc::ClientContext context;
    Set(&context);
    const auto stream = connection.stub().Simulate(&context, request);
    for (v1::SimulationMessage message; stream->Read(&message);) {
      whole.mutable_samples()->MergeFrom(message.samples().samples());
      if (message.has_event()) *whole.add_events() = message.event();
      if (message.has_report()) *whole.mutable_report() = message.report();
    }
    grpc::Status status = stream->Finish();
    Set(nullptr);
    return status;
  }
  void Wait(double seconds) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (interrupts_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return stopped_; })) {
      throw Failure(ExitCode::kCancelled, "");
    }
  }
  void Set(grpc::ClientContext* context) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (context != nullptr && stopped_) throw Failure(ExitCode::kCancelled, "");
    context_ = context;
  }
  void Stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
    interrupts_.notify_all();
    if (context_ != nullptr) context_->TryCancel();
  }

  const std::optional<double> max_wall_time_s_;
  std::condition_variable interrupts_;
  std::mutex mutex_;  // protects what follows
  bool stopped_ = false;
  grpc::ClientContext* context_ = nullptr;
  Interrupt interrupt_;  // last: its thread uses the others
};

std::string SettingsText(const ScenePoint& point) {
  return "tolerance " + FormatNumber(point.tolerance) +
         (point.absolute ? ", absolute " + FormatNumber(*point.absolute) : "") + ", drift " + DriftWord(point.drift);
}

std::string DigestOf(const v1::SimulationScene& scene, const std::vector<ScenePoint>& points, int repeats) {
  std::string all = std::to_string(repeats);
  for (const ScenePoint& point : points) all += Digest(SceneOfPoint(scene, point).SerializeAsString());
  return Digest(all);
}

// The rows that the same command kept in the folder; none if there is no file, or one of another command.
std::vector<nlohmann::json> KeptRows(const std::string& folder, const std::string& name) {
  std::ifstream file(std::filesystem::path(folder) / "tradeoff.json");
  if (!file) return {};
  try {
    const auto data = nlohmann::json::parse(file);
    if (data.at("tradeoff") != name) return {};
    return data.at("points").get<std::vector<nlohmann::json>>();
  } catch (const nlohmann::json::exception& error) {
    throw Failure(ExitCode::kUsage, "--output " + folder + ": tradeoff.json there is not of this program (" +
                                        error.what() + "); remove it, or name another folder");
  }
}

v1::Simulation RunReference(Simulator& simulator, Connection& connection, const v1::SimulationScene& scene,
                            const ScenePoint& point) {
  v1::Simulation reference = simulator.Run(connection, SceneOfPoint(scene, point));
  if (!IsCompleted(reference.report().end())) {
    throw Failure(ExitCode::kNoSolution, "tradeoff: the reference with " + SettingsText(point) + " " +
                                             SimulationEndText(reference.report().end()) +
                                             "; so no error is known; a larger least --tolerance makes it coarser");
  }
  return reference;
}

struct Measured {
  v1::Simulation run;
  double cpu_time_s;
};

// The median CPU time of so many runs, of an even number the lower one. On a busy virtual machine some runs of 1 to 3
// ms report exactly 0, for a reason that is not known; that is no time, so such a run does not count.
Measured Measure(Simulator& simulator, Connection& connection, const v1::SimulationScene& scene, int repeats) {
  Measured measured;
  std::vector<double> times;
  for (int i = 0; i < repeats + kMostWithoutTime && static_cast<int>(times.size()) < repeats; ++i) {
    measured.run = simulator.Run(connection, scene);
    if (measured.run.report().cpu_time_s() > 0) times.push_back(measured.run.report().cpu_time_s());
  }
  if (static_cast<int>(times.size()) < repeats) {
    throw Failure(ExitCode::kUsage, "tradeoff: more than " + std::to_string(kMostWithoutTime) +
                                        " reports have no cpu_time_s: the server is older than this client, or the "
                                        "simulation is too short for its clock; try a longer --duration");
  }
  std::sort(times.begin(), times.end());
  measured.cpu_time_s = times[(times.size() - 1) / 2];
  return measured;
}

}  // namespace

ExitCode RunSceneTradeoff(const TradeoffOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  SceneInput input = options.scene;
  input.duration_s = options.spec.duration_s;
  const v1::SimulationScene scene = ReadScene(input);
  const auto points =
      MakeScenePoints(scene, options.tolerances.value_or(kSceneTolerances), options.absolutes, options.drifts);
  const ScenePoint finest = Finer(points);
  TradeoffTable table = SceneTable(DigestOf(scene, points, options.repeats), SettingsText(finest));
  if (!options.output.empty()) {
    MakeFolder("--output", options.output);
    table.rows = KeptRows(options.output, table.name);
  }

  Progress progress(terminal, global.json || global.quiet ? Progress::Style::kSilent : ProgressStyle(global, terminal));
  Simulator simulator(options);
  Connection connection(global);
  if (!table.rows.empty()) {
    progress.Note(std::to_string(table.rows.size()) + " of " + std::to_string(points.size()) + " points are in " +
                  options.output + " already");
  }
  if (table.rows.size() < points.size()) {
    progress.Note("reference: " + SettingsText(finest));
    const v1::Simulation reference = RunReference(simulator, connection, scene, finest);
    const v1::Simulation before = RunReference(simulator, connection, scene, Finer(points, kBeforeReference));
    const double difference = ErrorsAgainst(scene, reference, before).pose();
    for (size_t i = table.rows.size(); i < points.size(); ++i) {
      const auto [run, cpu_time_s] = Measure(simulator, connection, SceneOfPoint(scene, points[i]), options.repeats);
      std::optional<SceneErrors> errors;
      if (IsCompleted(run.report().end())) errors = ErrorsAgainst(scene, reference, run);
      AddRow(table, SceneRow(points[i], run.report(), cpu_time_s, errors, difference));
      if (!options.output.empty()) {
        WriteFile((std::filesystem::path(options.output) / "tradeoff.json").string(),
                  TradeoffJson(table).dump(2) + "\n");
      }
      progress.Note("point " + std::to_string(i + 1) + "/" + std::to_string(points.size()) + ": " +
                    SettingsText(points[i]) + ": " + FormatDuration(cpu_time_s) + " CPU");
    }
  }
  progress.End();
  MarkFront(table);
  WriteTradeoff(table, options.output, global, terminal);
  const bool all = std::all_of(table.rows.begin(), table.rows.end(),
                               [](const nlohmann::json& row) { return row.contains("motion"); });
  return all ? ExitCode::kSuccess : ExitCode::kNoSolution;
}

}  // namespace rollgait::client
