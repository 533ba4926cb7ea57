#include <vector>

#include "client/commands/commands.h"
#include "client/commands/create_solve.h"
#include "client/commands/follow.h"
#include "client/output.h"
#include "client/paper/paper_page.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kSlopes_deg[] = {10, 0, -10};
constexpr double kSpeed_m_s = 1.3;  // the paper names none

// The paper's problem where no flag and no file says otherwise.
v1::SolveSpec PaperSpec(SpecFlags flags, double slope_deg) {
  flags.slope_deg = slope_deg;
  v1::SolveSpec spec = BuildSpec(flags);
  if (spec.model().name().empty()) spec.mutable_model()->set_name("human29");
  const bool own_cost = !spec.costs().empty() || spec.preset() != v1::PRESET_UNSPECIFIED;
  if (!own_cost) spec.add_costs()->mutable_squared_torque();
  const v1::Motion& motion = spec.motion();
  const bool free =
      motion.has_speed_m_s() || motion.free_speed() || motion.has_step_length_m() || motion.has_step_duration_s();
  if (!free) spec.mutable_motion()->set_speed_m_s(kSpeed_m_s);
  return spec;
}

std::string Table(const nlohmann::json& data) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& statement : data.at("statements")) {
    rows.push_back({statement.at("verdict"), statement.at("where"), statement.at("paper")});
    rows.push_back({"", "", "ours: " + statement.at("ours").get<std::string>()});
  }
  return FormatTable(rows, "l");
}

}  // namespace

ExitCode RunReproducePaper(const ReproducePaperOptions& options, const GlobalOptions& global,
                           const Terminal& terminal) {
  if (options.output.empty() && !global.json) {
    throw Failure(ExitCode::kUsage,
                  "reproduce-paper: name the page with --output FILE, or ask for the data with --json");
  }
  RequireOneDocument(options.output, global.json);
  const bool silent = global.json || global.quiet;
  Progress progress(terminal, silent ? Progress::Style::kSilent : ProgressStyle(global, terminal));
  CtrlC ctrl_c(CtrlC::Action::kCancelSolve, progress);
  Connection connection(global);
  std::vector<v1::Solve> solves;
  ExitCode code = ExitCode::kSuccess;
  for (const double slope_deg : kSlopes_deg) {
    v1::CreateSolveRequest request;
    *request.mutable_spec() = PaperSpec(options.spec, slope_deg);
    request.set_request_id(RandomRequestId());
    const v1::Solve created = CreateSolve(connection, request);
    progress.Note(FormatNumber(slope_deg) + " degrees: " + created.name());
    solves.push_back(Follow(connection, created.name(), {0, options.reconnect_s}, ctrl_c, progress));
    const ExitCode ended = ExitCodeOf(solves.back());
    if (ended == ExitCode::kCancelled) return ended;
    if (code == ExitCode::kSuccess) code = ended;
  }
  const nlohmann::json data = PaperData(solves);
  if (global.json)
    terminal.out << data.dump() << std::endl;
  else if (!global.quiet)
    TextStream(options.output, terminal) << Table(data) << std::flush;
  if (!options.output.empty()) {
    WriteDocument(PaperHtml(solves), options.output, terminal.out);
    if (!IsStandardOutput(options.output)) progress.Note("written: " + options.output);
  }
  return code;
}

}  // namespace rollgait::client
