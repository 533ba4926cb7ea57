#ifndef ROLLGAIT_SERVER_BASE_SUPERVISOR_H_
#define ROLLGAIT_SERVER_BASE_SUPERVISOR_H_

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/base/outcome.h"

namespace rollgait::server {

// Keeps one child process alive. The child gets an own process group, default signals, no inherited descriptors but
// standard error (also as its standard output), and as standard input the read end of a pipe that ends when this
// process dies, however it dies.
class Supervisor {
 public:
  struct Options {
    std::string name;                    // for the log
    std::vector<std::string> arguments;  // [0] is the path of the program
    // Pause before a new start of a child that died: doubles from first to last, back to first after a life of
    // `stable`.
    std::chrono::milliseconds first_pause{100}, last_pause{4'000}, stable{30'000};
  };

  // Starts the child. kUnavailable with the reason if that fails.
  static Outcome<std::unique_ptr<Supervisor>> Start(Options options);
  // Stops the child if Stop was not called.
  ~Supervisor();

  // SIGTERM, after `grace` SIGKILL; returns when the child is gone. It is not started again.
  void Stop(std::chrono::milliseconds grace);
  // The child now; 0 between a death and the next start.
  pid_t pid() const;

 private:
  Supervisor(Options options, int lifeline_read, int lifeline_write);
  Outcome<pid_t> Spawn() const;
  void Loop();
  // Waits for the end of the child. Returns its wait status.
  int Wait();

  const Options options_;
  const int lifeline_read_, lifeline_write_;
  mutable std::mutex mutex_;  // protects what follows
  std::condition_variable changed_;
  pid_t pid_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

// "exit code 3" or "signal 9 (Killed)".
std::string DescribeWaitStatus(int status);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SUPERVISOR_H_
