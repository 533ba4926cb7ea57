#ifndef ROLLGAIT_SERVER_AGENT_SOLVER_PROCESS_H_
#define ROLLGAIT_SERVER_AGENT_SOLVER_PROCESS_H_

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/agent/running_solver.h"
#include "server/base/outcome.h"

namespace rollgait::server {

// One rollgait-solve: a child with a stream for framed messages and a pipe for what it prints. One thread, which must
// be the thread that spawned it (the child dies with it). Movable; the destructor kills and reaps a child that is still
// there.
class SolverProcess final : public RunningSolver {
 public:
  struct Options {
    std::string program;
    int64_t memory_limit_mb = 4096;
    int64_t cpu_limit_s = 86400;
    bool unconfined = false;  // without its system call filter
  };

  // Starts a child that waits for its request. It gets no descriptor of this process but its own three and the stream,
  // an empty signal mask, and one BLAS thread. kUnavailable with the reason if that fails.
  static Outcome<SolverProcess> Spawn(const Options& options);
  SolverProcess(SolverProcess&& other) noexcept;
  SolverProcess& operator=(SolverProcess&& other) noexcept;
  ~SolverProcess() override;

  static constexpr int kMaxLoggedLines = 100;
  // Bytes of one message: a trajectory of the largest mesh has 51 MB.
  static constexpr size_t kMaxMessage = size_t{64} << 20;
  // Bytes of messages after which Receive leaves what follows to its next call.
  static constexpr size_t kAtOnce = size_t{1} << 20;

  pid_t pid() const override { return pid_; }
  int stream_fd() const override { return stream_fd_; }
  int output_fd() const override { return output_fd_; }
  bool wants_to_write() const override { return !unsent_.empty(); }

  void Send(std::string_view request) override;
  void Write() override;
  // kAtOnce and one more payload at most.
  FrameStatus Receive(std::vector<std::string>* payloads) override;
  // Whole lines go to the log too (event "solver.printed"), at most kMaxLoggedLines of them.
  void ReadOutput() override;
  std::string LastOutput() const override;

  void Kill(int signal) override;
  std::optional<ProcessEnd> Reap() override;

 private:
  SolverProcess(pid_t pid, int stream_fd, int output_fd) : pid_(pid), stream_fd_(stream_fd), output_fd_(output_fd) {}

  void Swap(SolverProcess& other) noexcept;
  void LogLines(std::string_view text);

  pid_t pid_;  // 0: reaped
  int stream_fd_;
  int output_fd_;
  FrameParser parser_{kMaxMessage};
  std::string unsent_;
  std::string output_;  // the last kilobyte
  std::string line_;    // printed, but not to its end
  int logged_lines_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_SOLVER_PROCESS_H_
