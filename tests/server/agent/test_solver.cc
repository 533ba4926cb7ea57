// Stands in for rollgait-solve in tests of the agent. It does what the model name of its request says, word for word:
//   iterations N   sends N iterations          sleep MS   sleeps
//   result         sends an optimal result     infeasible   sends a result without a solution
//   memory         sends KIND_MEMORY_LIMIT     garbage    sends bytes that are no frame
//   obey           waits for kCancelSignal, then sends a cancelled result
//   hang           waits for ever, deaf to kCancelSignal
//   close          closes its stream and waits for ever
//   flood N        sends N iterations of 1 MiB each, most of it unknown fields
//   iterates N     sends N iterates            long-iterate  sends one of more than kMaxIterateBytes
//   solutions N    sends N intermediate solutions, of objectives 1 to N
//   print WORD     prints                      crash      dies by SIGSEGV
//   untaken        alone: waits for ever, and has not said that the request arrived
//   xcpu           dies by SIGXCPU             once FILE  dies by SIGSEGV unless FILE exists; makes it
// After the last word it exits with status 0.
#include <fcntl.h>
#include <google/protobuf/unknown_field_set.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "server/base/cancel_signal.h"
#include "server/base/framing.h"
#include "server/base/iterate_files.h"
#include "server/base/wire.pb.h"

namespace rollgait::server {
namespace {

int stream = -1;

void Send(const wire::SolverMessage& message) { WriteFrame(stream, message.SerializeAsString()); }

void SendResult(v1::Termination termination) {
  wire::SolverMessage message;
  message.mutable_result()->set_termination(termination);
  Send(message);
}

void SendIterate(int index, const std::string& joint) {
  wire::SolverMessage message;
  message.mutable_iterate()->set_index(index);
  message.mutable_iterate()->add_joint_names(joint);
  Send(message);
}

void SendSolution(int objective) {
  wire::SolverMessage message;
  v1::SolveResult& solution = *message.mutable_intermediate();
  solution.set_objective(objective);
  solution.mutable_accuracy()->set_verdict(v1::VERDICT_EXCEEDED);
  solution.add_meshes()->add_intervals(10 * objective);
  v1::MeshStatistics& finer = *solution.add_meshes();
  finer.add_intervals(2 * 10 * objective);
  finer.set_for_errors(true);
  Send(message);
}

void Die(int signal) {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  ::signal(signal, SIG_DFL);
  raise(signal);
}

[[noreturn]] void WaitForEver() {
  while (true) pause();
}

void ObeyCancelSignal() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, kCancelSignal);
  sigprocmask(SIG_BLOCK, &set, nullptr);
  wire::SolverMessage ready;  // tells the test that it is caught now
  ready.mutable_iteration()->set_index(1000);
  Send(ready);
  int signal = 0;
  sigwait(&set, &signal);
  SendResult(v1::TERMINATION_CANCELLED);
}

// True if a descriptor beyond the three standard ones and the stream is open.
bool HasOtherDescriptors() {
  for (int fd = stream + 1; fd < 256; ++fd) {
    if (fcntl(fd, F_GETFD) >= 0) return true;
  }
  return false;
}

void DieOnce(const std::string& file) {
  if (access(file.c_str(), F_OK) == 0) return;
  std::ofstream(file).put('1');
  Die(SIGSEGV);
}

void Obey(std::istringstream& words) {
  std::string word, argument;
  int count = 0;
  while (words >> word) {
    if (word == "iterations" && words >> count) {
      for (int i = 0; i < count; ++i) {
        wire::SolverMessage message;
        message.mutable_iteration()->set_index(i);
        Send(message);
      }
    } else if (word == "flood" && words >> count) {
      wire::SolverMessage message;
      message.mutable_iteration()
          ->GetReflection()
          ->MutableUnknownFields(message.mutable_iteration())
          ->AddLengthDelimited(1000, std::string(1 << 20, 'x'));
      for (int i = 0; i < count; ++i) Send(message);
    } else if (word == "iterates" && words >> count) {
      for (int i = 0; i < count; ++i) SendIterate(i, "hip");
    } else if (word == "solutions" && words >> count) {
      for (int i = 1; i <= count; ++i) SendSolution(i);
    } else if (word == "long-iterate") {
      SendIterate(0, std::string(kMaxIterateBytes, 'x'));
    } else if (word == "sleep" && words >> count) {
      usleep(static_cast<useconds_t>(count) * 1000);
    } else if (word == "result") {
      SendResult(v1::TERMINATION_OPTIMAL);
    } else if (word == "infeasible") {
      SendResult(v1::TERMINATION_INFEASIBLE);
    } else if (word == "memory") {
      wire::SolverMessage message;
      message.mutable_error()->set_kind(v1::SolveError::KIND_MEMORY_LIMIT);
      Send(message);
    } else if (word == "garbage") {
      if (write(stream, "Killed by a bug\n", 16) != 16) std::abort();
    } else if (word == "obey") {
      ObeyCancelSignal();
    } else if (word == "hang") {
      ::signal(kCancelSignal, SIG_IGN);
      wire::SolverMessage ready;
      ready.mutable_iteration()->set_index(1000);
      Send(ready);
      WaitForEver();
    } else if (word == "untaken") {
      WaitForEver();
    } else if (word == "close") {
      close(stream);
      WaitForEver();
    } else if (word == "print" && words >> argument) {
      std::fprintf(stderr, "%s\n", argument.c_str());
    } else if (word == "crash") {
      Die(SIGSEGV);
    } else if (word == "xcpu") {
      Die(SIGXCPU);
    } else if (word == "once" && words >> argument) {
      DieOnce(argument);
    }
  }
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) {
  using namespace rollgait::server;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--fd") == 0) stream = std::atoi(argv[i + 1]);
  }
  // What the agent promises its children.
  if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr || std::getenv("PGPASSWORD") != nullptr) return 9;
  if (std::getenv("HOME") != nullptr || std::getenv("PATH") != nullptr || HasOtherDescriptors()) return 9;
  rollgait::wire::SolverMessage ready;
  ready.mutable_ready();
  Send(ready);
  std::string payload;
  rollgait::v1::SolveSpec spec;
  if (ReadFrame(stream, &payload) != FrameStatus::kOk || !spec.ParseFromString(payload)) return 0;
  std::istringstream words(spec.model().name());
  rollgait::wire::SolverMessage taken;
  taken.mutable_taken();
  if (!spec.model().name().starts_with("untaken")) Send(taken);
  Obey(words);
  return 0;
}
