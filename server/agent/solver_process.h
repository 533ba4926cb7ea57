#ifndef ROLLGAIT_SERVER_AGENT_SOLVER_PROCESS_H_
#define ROLLGAIT_SERVER_AGENT_SOLVER_PROCESS_H_

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/framing.h"
#include "server/base/outcome.h"

namespace rollgait::server {

// How a process ended and what it used.
struct ProcessEnd {
  int wait_status = 0;  // of waitpid
  double cpu_time_s = 0;
  int64_t peak_memory_bytes = 0;
};

// One rollgait-solve: a child with a stream for framed messages and a pipe for what it prints. One thread, which must
// be the thread that spawned it (the child dies with it). Movable; the destructor kills and reaps a child that is still
// there.
class SolverProcess {
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
  ~SolverProcess();

  static constexpr int kMaxLoggedLines = 100;
  // Bytes of one message: a trajectory of the largest mesh has 51 MB.
  static constexpr size_t kMaxMessage = size_t{64} << 20;
  // Bytes of messages after which Receive leaves what follows to its next call.
  static constexpr size_t kAtOnce = size_t{1} << 20;

  pid_t pid() const { return pid_; }
  // Non-blocking descriptors to poll, and whether the stream waits to be writable.
  int stream_fd() const { return stream_fd_; }
  int output_fd() const { return output_fd_; }
  bool wants_to_write() const { return !unsent_.empty(); }

  // Hands the request over; what does not fit into the socket goes out with Write.
  void Send(std::string_view request);
  // Writes on. A failure shows as the end of the stream.
  void Write();
  // Appends the payloads that have arrived, kAtOnce and one more at most. kNeedMore: the stream goes on; else its end:
  // kEnd, kTruncated, kGarbage, kTooLarge, kError.
  FrameStatus Receive(std::vector<std::string>* payloads);
  // Reads what the child has printed; whole lines go to the log too (event "solver.printed"), at most kMaxLoggedLines
  // of them.
  void ReadOutput();
  // The last of what the child has printed, in one line of printable characters.
  std::string LastOutput() const;

  void Kill(int signal);
  // The end of the child, once it has ended. Never blocks.
  std::optional<ProcessEnd> Reap();

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
