#ifndef ROLLGAIT_SERVER_AGENT_RUNNING_SOLVER_H_
#define ROLLGAIT_SERVER_AGENT_RUNNING_SOLVER_H_

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/framing.h"

namespace rollgait::server {

// How a process ended and what it used.
struct ProcessEnd {
  int wait_status = 0;  // of waitpid
  double cpu_time_s = 0;
  int64_t peak_memory_bytes = 0;
};

// A solver at work as its agent sees it: it is sent a request, sends messages (server/base/wire.proto), is told to stop
// or killed, and ends. No call blocks. One thread.
class RunningSolver {
 public:
  virtual ~RunningSolver() = default;

  virtual pid_t pid() const = 0;
  // Non-blocking descriptors to poll, and whether the stream waits to be writable.
  virtual int stream_fd() const = 0;
  virtual int output_fd() const = 0;
  virtual bool wants_to_write() const = 0;

  // Hands the request over; what does not fit goes out with Write.
  virtual void Send(std::string_view request) = 0;
  // Writes on. A failure shows as the end of the stream.
  virtual void Write() = 0;
  // Appends the payloads that have arrived. kNeedMore: the stream goes on; else its end: kEnd, kTruncated, kGarbage,
  // kTooLarge, kError.
  virtual FrameStatus Receive(std::vector<std::string>* payloads) = 0;
  // Reads what it has printed.
  virtual void ReadOutput() = 0;
  // The last of what it has printed, in one line of printable characters.
  virtual std::string LastOutput() const = 0;

  virtual void Kill(int signal) = 0;
  // Its end, once it has ended.
  virtual std::optional<ProcessEnd> Reap() = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_RUNNING_SOLVER_H_
