#ifndef ROLLGAIT_SERVER_SOLVE_WORKER_H_
#define ROLLGAIT_SERVER_SOLVE_WORKER_H_

#include <functional>

#include "core/base/stop.h"
#include "core/gait/gait_solver.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {

// Exit codes of rollgait-solve. For the parent only the last frame counts.
enum WorkerExit : int {
  kWorkerDone = 0,       // a result or an error was sent, or the parent closed the stream before it sent a request
  kWorkerNoRequest = 4,  // what came was no request
  kWorkerNoReader = 5,   // the parent has gone
};

// Serves one request on a connected stream: see wire.proto. `on_request` is called between the arrival of the request
// and the solve. `stop` is requested here if nobody reads any more. Never throws.
WorkerExit ServeOneRequest(int fd, GaitSolver& solver, StopFlag& stop,
                           const std::function<void(const GaitSpec&)>& on_request);

// From now on a failed allocation sends KIND_MEMORY_LIMIT on `fd` and ends the process: libraries that notice it carry
// on with something else. Covers `new` everywhere, and malloc where malloc_guard.cc is linked.
void ReportMemoryLimitOn(int fd);

// What a failed allocation leads to; returns if ReportMemoryLimitOn was not called.
void OnFailedAllocation();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SOLVE_WORKER_H_
