#include "client/commands/follow.h"

#include <unistd.h>

#include "client/failure.h"
#include "client/output.h"
#include "client/summary.h"

namespace rollgait::client {

CtrlC::CtrlC(Action action, Progress& progress) : action_(action), progress_(progress) {
  interrupt_ = std::make_unique<Interrupt>([this](int count) { OnInterrupt(count); });
}

CtrlC::~CtrlC() {
  interrupt_.reset();
  Release();
}

void CtrlC::Attach(SolveFollower* follower) {
  std::lock_guard<std::mutex> lock(mutex_);
  follower_ = follower;
  if (interrupted_) Act(*follower);
}

void CtrlC::Release() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    follower_ = nullptr;
  }
  if (canceller_.joinable()) canceller_.join();
}

void CtrlC::OnInterrupt(int count) {
  if (count > 1) {
    progress_.End();
    progress_.Note("stopped at once; the solve may still be running, see `rollgait list`");
    _exit(static_cast<int>(ExitCode::kCancelled));
  }
  progress_.Note(action_ == Action::kCancelSolve ? "cancelling the solve; Ctrl-C again to leave at once"
                                                 : "leaving; the solve goes on");
  std::lock_guard<std::mutex> lock(mutex_);
  interrupted_ = true;
  if (follower_ != nullptr) Act(*follower_);
}

void CtrlC::Act(SolveFollower& follower) {
  if (action_ == Action::kStopWatching) {
    follower.Stop();
    return;
  }
  if (canceller_.joinable()) return;
  canceller_ = std::thread([this, &follower] {
    const grpc::Status status = follower.Cancel();
    if (!status.ok()) {
      progress_.Note("the server has not taken the cancellation (" + status.error_message() +
                     "); it is sent again when the connection is back");
    }
  });
}

Progress::Style ProgressStyle(const GlobalOptions& global, const Terminal& terminal) {
  if (global.json) return Progress::Style::kJson;
  if (global.quiet) return Progress::Style::kSilent;
  return terminal.err_live ? Progress::Style::kLine : Progress::Style::kPlain;
}

v1::Solve Follow(Connection& connection, const std::string& name, const FollowOptions& options, CtrlC& ctrl_c,
                 Progress& progress) {
  SolveFollower follower(connection, name, options);
  ctrl_c.Attach(&follower);
  v1::Solve solve;
  try {
    solve = follower.Follow([&progress](const v1::SolveEvent& event) { progress.Show(event); },
                            [&progress](const std::string& note) { progress.Note(note); });
  } catch (...) {
    ctrl_c.Release();
    progress.End();
    throw;
  }
  ctrl_c.Release();
  progress.End();
  return solve;
}

ExitCode FollowToEnd(Connection& connection, const std::string& name, const FollowOptions& options,
                     const std::string& output, CtrlC& ctrl_c, Progress& progress, const Terminal& terminal) {
  const v1::Solve solve = Follow(connection, name, options, ctrl_c, progress);
  if (!connection.options().json && !connection.options().quiet) {
    TextStream(output, terminal) << Summarize(solve, terminal.out_color) << std::flush;
  }
  const ExitCode code = ExitCodeOf(solve);
  if (connection.options().quiet && code != ExitCode::kSuccess) {
    terminal.err << "rollgait: " << solve.name() << "  " << Verdict(solve) << std::endl;
  }
  if (!output.empty()) {
    try {
      WriteSolve(solve, output, terminal.out);
      if (!IsStandardOutput(output)) progress.Note("written: " + output);
    } catch (const Failure& failure) {
      terminal.err << "rollgait: " << failure.what() << std::endl;
      // How the solve ended says more than that there was nothing to write.
      return code == ExitCode::kSuccess ? failure.code() : code;
    }
  }
  return code;
}

}  // namespace rollgait::client
