#ifndef ROLLGAIT_SERVER_SIMULATE_SIMULATION_HOST_H_
#define ROLLGAIT_SERVER_SIMULATE_SIMULATION_HOST_H_

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "rollgait/v1/simulation.pb.h"
#include "server/base/outcome.h"
#include "server/base/wire.pb.h"

namespace rollgait::server {

struct SimulationHostOptions {
  std::string program;             // path of rollgait-simulate; empty: this server does not simulate
  int slots = 2;                   // simulations that run at once
  int64_t memory_limit_mb = 1024;  // of each
  bool unconfined = false;         // without their system call filter
};

// Wakes a thread that waits in poll. Any thread may call Cancel.
class SimulationCancel {
 public:
  SimulationCancel();
  ~SimulationCancel();
  SimulationCancel(const SimulationCancel&) = delete;
  SimulationCancel& operator=(const SimulationCancel&) = delete;
  void Cancel();
  bool cancelled() const { return cancelled_.load(); }
  int fd() const { return fd_; }  // readable once cancelled

 private:
  int fd_;
  std::atomic<bool> cancelled_{false};
};

// Runs simulations in processes of their own, each watched by a thread of its own: numerics never run in the server.
// Any thread may call.
class SimulationHost {
 public:
  // Runs a simulation; what it returns is called when the slot is free again, to tell the client of the end.
  using Job = std::function<std::function<void()>(SimulationCancel&)>;
  // Takes a message for the client; may wait for it to be read. False: the client has gone.
  using Emit = std::function<bool(v1::SimulationMessage&&)>;

  explicit SimulationHost(SimulationHostOptions options) : options_(std::move(options)) {}
  ~SimulationHost() { Stop(); }

  // Runs the job on a thread of its own. kUnavailable without a program or while stopping; kResourceExhausted without a
  // slot.
  Outcome<std::shared_ptr<SimulationCancel>> Start(Job job);
  // For a job: serves the request with a process and waits for its end, at most max_wall_s. kInvalidArgument: refused
  // by the process; kDeadlineExceeded; kResourceExhausted: memory limit; kUnavailable: cancelled or not to be started;
  // kInternal: it crashed or failed.
  Outcome<Done> Run(const wire::SimulatorRequest& request, double max_wall_s, SimulationCancel& cancel,
                    const Emit& emit) const;
  // Cancels what runs and waits for its end. Start refuses from now on.
  void Stop();

 private:
  struct Running {
    std::thread thread;
    std::shared_ptr<SimulationCancel> cancel;
    std::shared_ptr<std::atomic<bool>> done;
  };

  const SimulationHostOptions options_;
  std::mutex mutex_;
  bool stopping_ = false;
  std::list<Running> running_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SIMULATE_SIMULATION_HOST_H_
