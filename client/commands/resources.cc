// get, list, cancel, priority, delete, server-info: one call and its answer.
#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>

#include "client/commands/commands.h"
#include "client/json.h"
#include "client/list_filter.h"
#include "client/output.h"
#include "client/summary.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kLargestPage = 1000;

std::vector<std::string> ListRow(const v1::Solve& solve, bool with_tenant) {
  const auto seconds = [](const google::protobuf::Timestamp& time) {
    return static_cast<double>(time.seconds()) + 1e-9 * time.nanos();
  };
  const bool timed = solve.has_start_time() && solve.has_end_time();
  const auto& motion = solve.spec().motion();
  const v1::SolveOutcome& outcome = solve.outcome();
  std::vector<std::string> row = {
      solve.name(),
      StateName(solve.state()),
      outcome.termination() == v1::TERMINATION_UNSPECIFIED ? "-" : TerminationName(outcome.termination()),
      solve.has_outcome() ? VerdictName(outcome.verdict()) : "-",
      ListedModel(solve),
      FormatNumber(solve.spec().slope_rad() * 180 / kPi) + "°",
      motion.has_speed_m_s() ? FormatNumber(motion.speed_m_s()) + " m/s"
      : motion.free_speed()  ? "free"
                             : "-",
      FormatTime(solve.create_time()),
      timed ? FormatDuration(seconds(solve.end_time()) - seconds(solve.start_time())) : "-"};
  if (with_tenant) row.push_back(solve.tenant().empty() ? "-" : solve.tenant());
  return row;
}

// Calls `act` for each name; prints failures and goes on.
ExitCode ForEachName(const std::vector<std::string>& names, const Terminal& terminal,
                     const std::function<void(const std::string&)>& act) {
  ExitCode code = ExitCode::kSuccess;
  for (const std::string& name : names) {
    try {
      act(SolveName(name));
    } catch (const Failure& failure) {
      terminal.err << "rollgait: " << failure.what() << std::endl;
      code = failure.code();
    }
  }
  return code;
}

// The solves to act on, in one of these states if they are found by labels.
std::vector<std::string> NamesOf(const ChosenSolves& chosen, const std::string& command,
                                 const std::vector<v1::SolveState>& states, Connection& connection) {
  std::vector<std::string> names = chosen.names;
  if (names.empty() && chosen.labels.empty()) {
    throw Failure(ExitCode::kUsage, command + ": SOLVE or --label is required");
  }
  if (chosen.labels.empty()) return names;
  v1::ListSolvesRequest request = ListRequest({.labels = chosen.labels}, std::chrono::system_clock::now());
  request.set_page_size(kLargestPage);
  for (const v1::SolveState state : states) request.mutable_filter()->add_states(state);
  do {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::ListSolvesResponse response;
    RequireOk(connection.stub().ListSolves(&context, request, &response), "list the solves", connection.server());
    for (const v1::Solve& solve : response.solves()) names.push_back(solve.name());
    request.set_page_token(response.next_page_token());
  } while (!request.page_token().empty());
  return names;
}

}  // namespace

ExitCode RunGet(const GetOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!options.output.empty()) RequireOutputPath(options.output);
  RequireOneDocument(options.output, global.json);
  Connection connection(global);
  const v1::Solve solve = connection.GetSolve(options.name);
  if (global.json) {
    terminal.out << ToJsonText(solve);
  } else if (!global.quiet) {
    TextStream(options.output, terminal) << Summarize(solve, terminal.out_color) << std::flush;
  }
  terminal.out << std::flush;
  if (!options.output.empty()) WriteSolve(solve, options.output, terminal.out);
  return ExitCode::kSuccess;
}

// Pages until `limit` solves match or there are no more.
ExitCode RunList(const ListOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  v1::ListSolvesRequest request = ListRequest(options.filter, std::chrono::system_clock::now());
  Connection connection(global);
  const bool with_tenant = !options.filter.tenant.empty();
  bool with_priority = false;
  std::vector<std::string> priorities;
  std::vector<std::vector<std::string>> rows;
  bool more = true, limited = false;
  while (more && !limited) {
    request.set_page_size(options.filter.name_prefix.empty()
                              ? std::min(options.limit - static_cast<int>(rows.size()), kLargestPage)
                              : kLargestPage);
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::ListSolvesResponse response;
    RequireOk(connection.stub().ListSolves(&context, request, &response), "list the solves", connection.server());
    request.set_page_token(response.next_page_token());
    more = !response.next_page_token().empty();
    for (const v1::Solve& solve : response.solves()) {
      if (!HasNameOf(options.filter, solve)) continue;
      limited = static_cast<int>(rows.size()) == options.limit;
      if (limited) break;
      if (global.json) terminal.out << ToJsonLine(solve) << "\n";
      rows.push_back(ListRow(solve, with_tenant));
      priorities.push_back(std::to_string(solve.priority()));
      with_priority = with_priority || solve.priority() != 0;
    }
    limited = limited || (more && static_cast<int>(rows.size()) == options.limit);
  }
  if (!global.json && !rows.empty()) {
    rows.insert(rows.begin(), {"NAME", "STATE", "ENDED", "ACCURACY", "MODEL", "SLOPE", "SPEED", "CREATED", "RAN FOR"});
    if (with_tenant) rows.front().push_back("TENANT");
    priorities.insert(priorities.begin(), "PRIORITY");
    for (size_t i = 0; with_priority && i < rows.size(); ++i) rows[i].push_back(priorities[i]);
    terminal.out << FormatTable(rows, "lllllrr");
  }
  terminal.out << std::flush;
  if (!global.quiet && !global.json && rows.empty()) terminal.err << "no solves" << std::endl;
  if (!global.quiet && !global.json && limited) {
    terminal.err << "there may be more; --limit " << options.limit << " was reached" << std::endl;
  }
  return ExitCode::kSuccess;
}

ExitCode RunCancel(const ChosenSolves& chosen, const GlobalOptions& global, const Terminal& terminal) {
  Connection connection(global);
  const std::vector<std::string> names =
      NamesOf(chosen, "cancel", {v1::SOLVE_STATE_QUEUED, v1::SOLVE_STATE_RUNNING}, connection);
  return ForEachName(names, terminal, [&](const std::string& name) {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::CancelSolveRequest request;
    request.set_name(name);
    v1::Solve solve;
    RequireOk(connection.stub().CancelSolve(&context, request, &solve), "cancel " + name, connection.server());
    if (global.json) {
      terminal.out << ToJsonLine(solve) << std::endl;
    } else if (!global.quiet) {
      terminal.out << name << "  " << StateName(solve.state()) << std::endl;
    }
  });
}

ExitCode RunPriority(const PriorityOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  Connection connection(global);
  const std::vector<std::string> names = NamesOf(options.chosen, "priority", {v1::SOLVE_STATE_QUEUED}, connection);
  return ForEachName(names, terminal, [&](const std::string& name) {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::SetSolvePriorityRequest request;
    request.set_name(name);
    request.set_priority(options.priority);
    v1::Solve solve;
    RequireOk(connection.stub().SetSolvePriority(&context, request, &solve), "change the priority of " + name,
              connection.server());
    if (global.json) {
      terminal.out << ToJsonLine(solve) << std::endl;
    } else if (!global.quiet) {
      terminal.out << name << "  priority " << solve.priority() << std::endl;
    }
  });
}

ExitCode RunDelete(const ChosenSolves& chosen, const GlobalOptions& global, const Terminal& terminal) {
  Connection connection(global);
  const std::vector<std::string> names = NamesOf(
      chosen, "delete", {v1::SOLVE_STATE_SUCCEEDED, v1::SOLVE_STATE_FAILED, v1::SOLVE_STATE_CANCELLED}, connection);
  return ForEachName(names, terminal, [&](const std::string& name) {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::DeleteSolveRequest request;
    request.set_name(name);
    google::protobuf::Empty empty;
    RequireOk(connection.stub().DeleteSolve(&context, request, &empty), "delete " + name, connection.server());
    if (!global.quiet && !global.json) terminal.out << name << "  deleted" << std::endl;
  });
}

namespace {

std::string AuthenticationName(const v1::Caller& caller) {
  switch (caller.authentication()) {
    case v1::Caller::AUTHENTICATION_TOKEN:
      return "token " + caller.identity();
    case v1::Caller::AUTHENTICATION_CERTIFICATE:
      return "certificate of " + caller.identity();
    default:
      return "nothing: the server does not ask who calls";
  }
}

}  // namespace

ExitCode RunServerInfo(const GlobalOptions& global, const Terminal& terminal) {
  Connection connection(global);
  grpc::ClientContext context;
  connection.SetDeadline(context);
  v1::ServerInfo info;
  RequireOk(connection.stub().GetServerInfo(&context, {}, &info), "ask the server", connection.server());
  if (global.json) {
    terminal.out << ToJsonText(info) << std::flush;
    return ExitCode::kSuccess;
  }
  const v1::Caller& caller = info.caller();
  std::string scopes;
  for (const std::string& scope : caller.scopes()) scopes += (scopes.empty() ? "" : ", ") + scope;
  const auto limit = [](double value) { return value > 0 ? FormatNumber(value, 6) : std::string("none"); };
  std::vector<std::vector<std::string>> rows = {
      {"server", global.server},
      {"version", info.version()},
      {"solver", info.solver_build()},
      {"solver slots", std::to_string(info.solver_slots())},
      {"running", std::to_string(info.running())},
      {"queued", std::to_string(info.queued())},
      {"largest request", std::to_string(info.max_request_bytes()) + " bytes"},
      {"up for", FormatDuration(info.uptime_s())},
      {"store", info.store()},
      {"authenticated by", AuthenticationName(caller)}};
  if (!caller.tenant().empty()) {
    rows.insert(rows.end(), {{"tenant", caller.tenant()},
                             {"scopes", scopes},
                             {"queued at most", limit(caller.limits().max_queued())},
                             {"running at most", limit(caller.limits().max_running())},
                             {"streams at most", limit(caller.limits().max_watches())},
                             {"created at most", limit(caller.limits().creates_per_s()) +
                                                     (caller.limits().creates_per_s() > 0 ? " /s" : "")}});
  }
  terminal.out << FormatTable(rows, "l") << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
