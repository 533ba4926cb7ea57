// Ctrl-C while a command follows several solves.
#ifndef ROLLGAIT_CLIENT_SWEEP_LEAVE_H_
#define ROLLGAIT_CLIENT_SWEEP_LEAVE_H_

#include <condition_variable>
#include <mutex>

#include "client/interrupt.h"
#include "client/progress.h"
#include "client/sweep/group_follower.h"

namespace rollgait::client {

// Ctrl-C leaves the solves alone; a second one ends the process. Made before the first gRPC object of the process.
class Leave {
 public:
  explicit Leave(Progress& progress);

  // Stops this one from now on, also for a Ctrl-C that has come already; nullptr: none.
  void Attach(GroupFollower* follower);
  // Throws Failure(kCancelled) at a Ctrl-C.
  void Wait(double seconds);

 private:
  void OnInterrupt(int count);

  Progress& progress_;
  std::condition_variable interrupts_;
  std::mutex mutex_;  // protects what follows
  GroupFollower* follower_ = nullptr;
  bool interrupted_ = false;
  Interrupt interrupt_;  // last: its thread uses the others
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_LEAVE_H_
