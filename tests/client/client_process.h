// The program `rollgait` as a process of its own, with its standard streams in the test's hands.
#ifndef ROLLGAIT_TESTS_CLIENT_CLIENT_PROCESS_H_
#define ROLLGAIT_TESTS_CLIENT_CLIENT_PROCESS_H_

#include <sys/types.h>

#include <string>
#include <vector>

namespace rollgait::client {

class ClientProcess {
 public:
  struct Options {
    bool terminal = false;                 // Standard error is a terminal of 60 columns.
    std::vector<std::string> environment;  // "NAME=value", on top of PATH, HOME, TERM=xterm and no configuration file
  };

  // Starts the program with the arguments.
  ClientProcess(const std::vector<std::string>& arguments, const Options& options);
  explicit ClientProcess(const std::vector<std::string>& arguments) : ClientProcess(arguments, Options()) {}
  // Kills it if it still runs.
  ~ClientProcess();
  ClientProcess(const ClientProcess&) = delete;
  ClientProcess& operator=(const ClientProcess&) = delete;

  // Reads until standard error contains the text; false when the program closes it before that, or after 30 s.
  bool WaitForError(const std::string& text);
  void Signal(int signal);
  // Reads to the end and returns the exit code; 1000 + signal if a signal ended it.
  int Wait();

  const std::string& out() const { return out_; }
  const std::string& err() const { return err_; }

 private:
  bool Read(int timeout_ms);

  pid_t pid_ = -1;
  int out_fd_ = -1, err_fd_ = -1;
  std::string out_, err_;
};

struct Ended {
  int code;
  std::string out, err;
};

// Runs the program to its end.
Ended RunToEnd(const std::vector<std::string>& arguments);

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_CLIENT_PROCESS_H_
