#include "bench/verdict_audit/children.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace rollgait::audit {
namespace {

struct Child {
  int number;
  int pipe;  // its text comes from here; longer ones than a pipe holds are not written
};

void WriteAll(int pipe, const std::string& text) {
  for (size_t written = 0; written < text.size();) {
    const ssize_t count = write(pipe, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    written += static_cast<size_t>(count);
  }
}

std::string ReadAll(int pipe) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<size_t>(count));
  }
}

}  // namespace

void RunInChildren(int count, int jobs, const std::function<std::string(int)>& work,
                   const std::function<void(int, const std::string&)>& done) {
  constexpr size_t kPipe = 60000;  // Linux: a pipe holds 65536 bytes, so that a child can end before it is read
  std::map<pid_t, Child> running;
  for (int next = 0; next < count || !running.empty();) {
    if (next < count && static_cast<int>(running.size()) < jobs) {
      std::array<int, 2> ends;
      std::fflush(stdout);
      if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
      const pid_t child = fork();
      if (child < 0) throw std::runtime_error("no process");
      if (child == 0) {
        close(ends[0]);
        WriteAll(ends[1], work(next).substr(0, kPipe));
        _exit(0);
      }
      close(ends[1]);
      running[child] = {next++, ends[0]};
      continue;
    }
    int status = 0;
    const pid_t ended = waitpid(-1, &status, 0);
    if (ended < 0) continue;  // interrupted
    const Child child = running.at(ended);
    running.erase(ended);
    const std::string text = ReadAll(child.pipe);
    close(child.pipe);
    done(child.number, WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : "");
  }
}

}  // namespace rollgait::audit
