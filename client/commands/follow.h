// What `solve` and `watch` share: following a solve with live output, and its end.
#ifndef ROLLGAIT_CLIENT_COMMANDS_FOLLOW_H_
#define ROLLGAIT_CLIENT_COMMANDS_FOLLOW_H_

#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "client/failure.h"
#include "client/follower.h"
#include "client/interrupt.h"
#include "client/progress.h"
#include "client/terminal.h"

namespace rollgait::client {

// Turns Ctrl-C into CancelSolve (or into leaving), and the second Ctrl-C into the end of the process with exit code
// kCancelled. Must be made before the first gRPC object of the process.
class CtrlC {
 public:
  enum class Action { kCancelSolve, kStopWatching };
  CtrlC(Action action, Progress& progress);
  ~CtrlC();

  // From now on, and for a Ctrl-C that has come already, acts on this follower; it must outlive the CtrlC or be
  // released.
  void Attach(SolveFollower* follower);
  void Release();

 private:
  void OnInterrupt(int count);
  void Act(SolveFollower& follower);

  const Action action_;
  Progress& progress_;
  std::mutex mutex_;
  SolveFollower* follower_ = nullptr;
  bool interrupted_ = false;
  std::thread canceller_;  // Sends CancelSolve, so that the signal thread is free for the second Ctrl-C.
  std::unique_ptr<Interrupt> interrupt_;
};

// The progress style that the options and the terminal ask for.
Progress::Style ProgressStyle(const GlobalOptions& global, const Terminal& terminal);

// Follows `name` to its end with live output. Throws Failure.
v1::Solve Follow(Connection& connection, const std::string& name, const FollowOptions& options, CtrlC& ctrl_c,
                 Progress& progress);

// Follows `name` to its end and prints its summary (unless --json, which has printed the Solve, or --quiet); writes
// `output` if it is not empty. Returns the exit code of the solve.
ExitCode FollowToEnd(Connection& connection, const std::string& name, const FollowOptions& options,
                     const std::string& output, CtrlC& ctrl_c, Progress& progress, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_FOLLOW_H_
