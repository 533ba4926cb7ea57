#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <condition_variable>
#include <csignal>
#include <iostream>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "client/commands/commands.h"
#include "client/commands/finished_solve.h"
#include "client/commands/solve_iterations.h"
#include "client/follower.h"
#include "client/interrupt.h"
#include "client/report/report.h"
#include "client/text.h"
#include "client/view/iterate_data.h"
#include "client/view/live_feed.h"
#include "client/view/page_server.h"

extern char** environ;

namespace rollgait::client {
namespace {

constexpr int kIteratesPerSecond = 4;

// Ctrl-C: ends the follower and the wait for it. The second one ends the process.
class Leaving {
 public:
  void Interrupt(int count) {
    if (count > 1) _exit(static_cast<int>(ExitCode::kSuccess));
    const std::lock_guard<std::mutex> lock(mutex_);
    interrupted_ = true;
    if (follower_ != nullptr) follower_->Stop();
    changed_.notify_all();
  }
  // Null: none any more.
  void Attach(SolveFollower* follower) {
    const std::lock_guard<std::mutex> lock(mutex_);
    follower_ = follower;
    if (interrupted_ && follower != nullptr) follower->Stop();
  }
  bool interrupted() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return interrupted_;
  }
  void Wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return interrupted_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool interrupted_ = false;
  SolveFollower* follower_ = nullptr;
};

// The solve as the page shows it: as it runs, then as it ended. Threads may share it.
class Shown {
 public:
  explicit Shown(v1::Solve running) : running_(std::move(running)) {}
  void Finish(ReportedSolve solve) {
    const std::lock_guard<std::mutex> lock(mutex_);
    finished_ = std::make_shared<const ReportedSolve>(std::move(solve));
  }
  std::string Page(const std::string& nonce) {
    std::shared_ptr<const ReportedSolve> finished;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      finished = finished_;
    }
    return finished != nullptr ? ReportHtml({*finished}, "", nonce) : LiveHtml(running_, nonce);
  }

 private:
  const v1::Solve running_;
  std::mutex mutex_;
  std::shared_ptr<const ReportedSolve> finished_;
};

bool IsFinished(const v1::Solve& solve) {
  return solve.state() != v1::SOLVE_STATE_QUEUED && solve.state() != v1::SOLVE_STATE_RUNNING;
}

// The caller's newest solve in this state, if there is one; unspecified: in any.
std::optional<std::string> Newest(Connection& connection, v1::SolveState state) {
  v1::ListSolvesRequest request;
  request.set_page_size(1);
  request.set_state(state);
  grpc::ClientContext context;
  connection.SetDeadline(context);
  v1::ListSolvesResponse response;
  RequireOk(connection.stub().ListSolves(&context, request, &response), "list the solves", connection.server());
  if (response.solves().empty()) return std::nullopt;
  return response.solves(0).name();
}

std::string NewestName(Connection& connection) {
  std::optional<std::string> name = Newest(connection, v1::SOLVE_STATE_RUNNING);
  if (!name) name = Newest(connection, v1::SOLVE_STATE_UNSPECIFIED);
  if (!name) {
    throw Failure(ExitCode::kNotFound,
                  "there are no solves on " + connection.server() + "; make one with `rollgait solve --detach`");
  }
  return *name;
}

v1::Model ModelOf(Connection& connection, const v1::Solve& solve) {
  v1::GetModelRequest request;
  *request.mutable_model() = solve.spec().model();
  request.set_joint_chains(true);  // as iterates have them
  grpc::ClientContext context;
  connection.SetDeadline(context);
  v1::Model model;
  RequireOk(connection.stub().GetModel(&context, request, &model), "get the model of " + solve.name(),
            connection.server());
  return model;
}

// With the signals of a program that is started from a shell, and without our standard output, which is for the
// address.
void OpenBrowser(const std::string& url, const Terminal& terminal) {
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C is not for it
  sigset_t ignored;
  sigemptyset(&ignored);
  sigaddset(&ignored, SIGPIPE);  // by the HTTP library
  posix_spawnattr_setsigdefault(&attributes, &ignored);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open", argument = url;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t pid = 0;
  const int failure = posix_spawnp(&pid, program.c_str(), &files, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) {
    terminal.err << "rollgait: xdg-open cannot be started (" << std::generic_category().message(failure)
                 << "); open the address in a browser yourself" << std::endl;
  }
}

std::string InWords(const v1::SolveEvent::StateChange& change) {
  const std::string attempt = change.attempt() > 1 ? " (attempt " + std::to_string(change.attempt()) + ")" : "";
  return change.state() == v1::SOLVE_STATE_QUEUED ? "The solve waits for its turn" + attempt + "."
                                                  : "The solve is " + StateName(change.state()) + attempt + ".";
}

// Tells the feed what happens until the solve ends. nullopt: Ctrl-C came first.
std::optional<v1::Solve> FollowInto(LiveFeed& feed, const v1::Model& model, Connection& connection,
                                    const std::string& name, double reconnect_s, Leaving& leaving) {
  SolveFollower follower(connection, name, {0, reconnect_s, kIteratesPerSecond});
  leaving.Attach(&follower);
  const auto detach = [](Leaving* from) { from->Attach(nullptr); };
  const std::unique_ptr<Leaving, decltype(detach)> attached(&leaving, detach);  // until the follower ends
  const auto on_event = [&](const v1::SolveEvent& event) {
    if (event.has_state_change()) feed.SetState(InWords(event.state_change()));
    if (event.has_iteration()) feed.Add(event.iteration());
    if (event.has_iterate()) feed.ShowIterate(IterateData(event.iterate(), model));
  };
  try {
    return follower.Follow(on_event, [&feed](const std::string& note) { feed.SetState(note); });
  } catch (const Failure&) {
    if (leaving.interrupted()) return std::nullopt;
    throw;
  }
}

void Announce(PageServer& server, const ViewOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  const std::string url = server.url();
  terminal.out << (global.json ? nlohmann::json({{"url", url}}).dump() : url) << std::endl;
  if (!global.quiet) terminal.err << "serving the page until Ctrl-C" << std::endl;
  if (options.opens) OpenBrowser(server.MakeUrlForOneUse(), terminal);
}

}  // namespace

ExitCode RunView(const ViewOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  Leaving leaving;
  const Interrupt interrupt([&leaving](int count) { leaving.Interrupt(count); });  // before the first thread
  std::unique_ptr<Connection> connection;
  const bool is_file = IsSolveFile(options.solve);
  v1::Solve solve;
  if (is_file) {
    solve = FinishedSolve(options.solve, global, connection);
  } else {
    connection = std::make_unique<Connection>(global);
    solve = connection->GetSolve(options.solve.empty() ? NewestName(*connection) : options.solve);
  }
  LiveFeed feed;
  Shown shown(solve);
  const auto finish = [&](const v1::Solve& finished) {
    shown.Finish({finished, is_file ? std::vector<v1::Iteration>() : ReadIterations(*connection, finished, terminal)});
    feed.End();
  };
  if (IsFinished(solve)) finish(solve);
  const v1::Model model = IsFinished(solve) ? v1::Model() : ModelOf(*connection, solve);
  PageServer server(
      options.port, [&shown](const std::string& nonce) { return shown.Page(nonce); }, feed);
  Announce(server, options, global, terminal);
  if (!IsFinished(solve)) {
    const std::optional<v1::Solve> finished =
        FollowInto(feed, model, *connection, solve.name(), options.reconnect_s, leaving);
    if (!finished) return ExitCode::kSuccess;
    finish(*finished);
    if (!global.quiet) terminal.err << solve.name() << " has ended: the page is its report" << std::endl;
  }
  leaving.Wait();
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
