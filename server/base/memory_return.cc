#include "server/base/memory_return.h"

#include <malloc.h>

#include <chrono>
#include <cstddef>

namespace rollgait::server {
namespace {

constexpr std::chrono::seconds kInterval{10};          // malloc_trim of a few GB takes tens of milliseconds
constexpr size_t kFreeThatMayStay = size_t{64} << 20;  // less than a request and its answer use at times

}  // namespace

MemoryReturn::MemoryReturn() : thread_([this] { Loop(); }) {}

MemoryReturn::~MemoryReturn() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MemoryReturn::Loop() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, kInterval, [this] { return stopping_; })) {
    lock.unlock();
    if (mallinfo2().fordblks > kFreeThatMayStay) malloc_trim(0);
    lock.lock();
  }
}

}  // namespace rollgait::server
