#ifndef ROLLGAIT_SERVER_BASE_LOG_WRITER_H_
#define ROLLGAIT_SERVER_BASE_LOG_WRITER_H_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace rollgait::server {

// Writes lines to a descriptor in a thread of its own, so that a reader who stands still holds up nobody who logs. What
// waits is bounded: when there is no room, the oldest lines are dropped and counted. Threads may share it.
class LogWriter {
 public:
  struct Options {
    int fd = 2;                                              // not closed
    size_t most_bytes = size_t{4} << 20;                     // of lines that wait: about 10 000
    std::function<std::string(int64_t lines)> dropped_line;  // stands where lines were dropped; called in the thread
  };
  explicit LogWriter(Options options);
  // Waits for at most kEndWait until all is written; what the reader has not taken by then is lost.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  static constexpr std::chrono::milliseconds kEndWait{500};  // a tenth of what a call has to end at SIGTERM

  // `line` with its line feed. Never waits for the reader.
  void Write(std::string line);
  // Waits until all that was given before is written; false: not within `at_most`.
  bool Flush(std::chrono::milliseconds at_most);
  // Lines dropped so far.
  int64_t dropped() const;

 private:
  struct Queue;
  static void Run(Queue& queue);

  const std::shared_ptr<Queue> queue_;  // shared with the thread, which a reader may hold beyond the end of this object
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LOG_WRITER_H_
