// Stands in for rollgait-solve in tests of the whole server: as many iterations as solver_limits.max_iterations allows
// (default 60), 10 ms apart, then an optimal result; on kCancelSignal a cancelled one. Its iterations fall from
// objective 1. With the thread sanitizer they are 30 ms apart, so that what a test does in the middle of a solve,
// slower then, is still in the middle.
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "server/base/cancel_signal.h"
#include "server/base/framing.h"
#include "server/base/wire.pb.h"

namespace {

#ifdef ROLLGAIT_THREAD_SANITIZER
constexpr useconds_t kPauseMicros = 30'000;
#else
constexpr useconds_t kPauseMicros = 10'000;
#endif

volatile sig_atomic_t stop_requested = 0;

void HandleStop(int) { stop_requested = 1; }

}  // namespace

int main(int argc, char** argv) {
  using namespace rollgait;
  using namespace rollgait::server;
  int stream = -1;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--fd") == 0) stream = std::atoi(argv[i + 1]);
  }
  wire::SolverMessage ready;
  ready.mutable_ready();
  if (WriteFrame(stream, ready.SerializeAsString()) != FrameStatus::kOk) return 1;
  std::string payload;
  v1::SolveSpec spec;
  if (ReadFrame(stream, &payload) != FrameStatus::kOk || !spec.ParseFromString(payload)) return 0;
  wire::SolverMessage taken;
  taken.mutable_taken();
  if (WriteFrame(stream, taken.SerializeAsString()) != FrameStatus::kOk) return 1;
  signal(kCancelSignal, HandleStop);
  signal(SIGPIPE, SIG_IGN);
  const int count = spec.solver_limits().has_max_iterations() ? spec.solver_limits().max_iterations() : 60;
  for (int i = 0; i < count && stop_requested == 0; ++i) {
    wire::SolverMessage message;
    message.mutable_iteration()->set_index(i);
    message.mutable_iteration()->set_objective(1.0 / (1 + i));
    if (WriteFrame(stream, message.SerializeAsString()) != FrameStatus::kOk) return 1;
    usleep(kPauseMicros);
  }
  wire::SolverMessage message;
  message.mutable_result()->set_termination(stop_requested == 0 ? v1::TERMINATION_OPTIMAL : v1::TERMINATION_CANCELLED);
  message.mutable_result()->set_message("from the test's solver");
  return WriteFrame(stream, message.SerializeAsString()) == FrameStatus::kOk ? 0 : 1;
}
