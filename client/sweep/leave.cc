#include "client/sweep/leave.h"

#include <unistd.h>

#include <chrono>
#include <string>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {

Leave::Leave(Progress& progress) : progress_(progress), interrupt_([this](int count) { OnInterrupt(count); }) {}

void Leave::Attach(GroupFollower* follower) {
  const std::lock_guard<std::mutex> lock(mutex_);
  follower_ = follower;
  if (interrupted_ && follower_ != nullptr) follower_->Stop();
}

void Leave::Wait(double seconds) {
  progress_.Note("the server asks to wait " + FormatDuration(seconds) + " before it makes the next solves");
  std::unique_lock<std::mutex> lock(mutex_);
  if (interrupts_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return interrupted_; })) {
    throw Failure(ExitCode::kCancelled, "");
  }
}

void Leave::OnInterrupt(int count) {
  if (count > 1) _exit(static_cast<int>(ExitCode::kCancelled));
  progress_.Note("leaving; the solves go on, and the same command goes on with them");
  const std::lock_guard<std::mutex> lock(mutex_);
  interrupted_ = true;
  interrupts_.notify_all();
  if (follower_ != nullptr) follower_->Stop();
}

}  // namespace rollgait::client
