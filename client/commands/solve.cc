#include <nlohmann/json.hpp>

#include "client/commands/commands.h"
#include "client/commands/create_solve.h"
#include "client/commands/follow.h"
#include "client/flag_values.h"
#include "client/json.h"
#include "client/output.h"
#include "client/predict/predict_time.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

ExitCode Predict(const v1::SolveSpec& spec, const GlobalOptions& global, const Terminal& terminal) {
  const PredictedTime time = PredictTime(spec, MeasuredTimes());
  if (!time.cpu_s) throw Failure(ExitCode::kNotFound, time.reason);
  if (global.json) {
    terminal.out << nlohmann::json{{"cpuTimeS", *time.cpu_s},
                                   {"lowS", time.low_s},
                                   {"highS", time.high_s},
                                   {"solves", time.solves},
                                   {"source", SourceOfMeasuredTimes()}}
                 << std::endl;
    return ExitCode::kSuccess;
  }
  terminal.out << "about " << FormatDuration(*time.cpu_s) << " CPU, " << FormatDuration(time.low_s) << " to "
               << FormatDuration(time.high_s) << ", by " << time.solves << " measured solves ("
               << SourceOfMeasuredTimes() << ")" << std::endl;
  return ExitCode::kSuccess;
}

}  // namespace

ExitCode RunSolve(const SolveOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!options.output.empty()) RequireOutputPath(options.output);
  RequireOneDocument(options.output, global.json);
  if (options.detach && !options.output.empty()) {
    throw Failure(ExitCode::kUsage, "--output with --detach: there is nothing to write yet; later use `rollgait get`");
  }
  if (options.predict) return Predict(BuildSpec(options.spec), global, terminal);
  v1::CreateSolveRequest request;
  *request.mutable_spec() = BuildSpec(options.spec);
  for (const std::string& label : options.labels) {
    const auto [key, value] = ParseLabel(label);
    (*request.mutable_labels())[key] = value;
  }
  request.set_request_id(options.request_id.empty() ? RandomRequestId() : options.request_id);
  request.set_priority(options.priority);
  request.set_validate_only(options.validate_only);

  Progress progress(terminal, ProgressStyle(global, terminal));
  if (options.validate_only || options.detach) {
    Connection connection(global);
    const v1::Solve solve = CreateSolve(connection, request);
    if (global.json) {
      terminal.out << ToJsonLine(solve) << std::endl;
    } else if (options.detach) {
      terminal.out << solve.name() << std::endl;
    } else if (!global.quiet) {
      terminal.out << "the request is valid" << std::endl;
    }
    return ExitCode::kSuccess;
  }
  CtrlC ctrl_c(CtrlC::Action::kCancelSolve, progress);
  Connection connection(global);
  const v1::Solve solve = CreateSolve(connection, request);
  if (!global.json) progress.Note(solve.name());
  return FollowToEnd(connection, solve.name(), {0, options.reconnect_s}, options.output, ctrl_c, progress, terminal);
}

}  // namespace rollgait::client
