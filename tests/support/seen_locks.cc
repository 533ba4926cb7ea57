// Loaded before the libraries (thread_reports): shows the thread sanitizer the locks of Abseil, which gRPC takes. They
// are built on futexes in libraries without the sanitizer. What was done before a lock was released comes before what
// is done after it was taken next; nothing else is said, so races in code that takes no lock are seen as before.
#include <absl/synchronization/mutex.h>
#include <dlfcn.h>
#include <grpc/grpc.h>

// Of the sanitizer; missing in programs that are built without it.
extern "C" {
__attribute__((weak)) void __tsan_acquire(void* address);
__attribute__((weak)) void __tsan_release(void* address);
}

namespace {

void Acquire(void* lock) {
  if (__tsan_acquire != nullptr) __tsan_acquire(lock);
}

void Release(void* lock) {
  if (__tsan_release != nullptr) __tsan_release(lock);
}

// The function of the same name in the library, found by that of this one.
void* Next(void* here) {
  Dl_info info;
  if (dladdr(here, &info) == 0 || info.dli_sname == nullptr) __builtin_trap();
  void* const next = dlsym(RTLD_NEXT, info.dli_sname);
  if (next == nullptr) __builtin_trap();
  return next;
}

template <typename Function, typename Member>
Function NextOf(Member member) {
  return reinterpret_cast<Function>(Next(reinterpret_cast<void*>(member)));
}

}  // namespace

namespace absl {
ABSL_NAMESPACE_BEGIN

void Mutex::Lock() {
  static const auto next = NextOf<void (*)(Mutex*)>(&Mutex::Lock);
  next(this);
  Acquire(this);
}

void Mutex::Unlock() {
  static const auto next = NextOf<void (*)(Mutex*)>(&Mutex::Unlock);
  Release(this);
  next(this);
}

bool Mutex::TryLock() {
  static const auto next = NextOf<bool (*)(Mutex*)>(&Mutex::TryLock);
  const bool locked = next(this);
  if (locked) Acquire(this);
  return locked;
}

void CondVar::Wait(Mutex* mutex) {
  static const auto next = NextOf<void (*)(CondVar*, Mutex*)>(static_cast<void (CondVar::*)(Mutex*)>(&CondVar::Wait));
  Release(mutex);
  next(this, mutex);
  Acquire(mutex);
}

bool CondVar::WaitWithTimeout(Mutex* mutex, absl::Duration timeout) {
  static const auto next = NextOf<bool (*)(CondVar*, Mutex*, absl::Duration)>(&CondVar::WaitWithTimeout);
  Release(mutex);
  const bool late = next(this, mutex, timeout);
  Acquire(mutex);
  return late;
}

bool CondVar::WaitWithDeadline(Mutex* mutex, absl::Time deadline) {
  static const auto next = NextOf<bool (*)(CondVar*, Mutex*, absl::Time)>(&CondVar::WaitWithDeadline);
  Release(mutex);
  const bool late = next(this, mutex, deadline);
  Acquire(mutex);
  return late;
}

ABSL_NAMESPACE_END
}  // namespace absl

// The tag of a batch is unique while it is under way.
extern "C" {

grpc_call_error grpc_call_start_batch(grpc_call* call, const grpc_op* ops, size_t count, void* tag, void* reserved) {
  static const auto next = NextOf<decltype(&grpc_call_start_batch)>(&grpc_call_start_batch);
  Release(tag);
  return next(call, ops, count, tag, reserved);
}

grpc_event grpc_completion_queue_next(grpc_completion_queue* queue, gpr_timespec deadline, void* reserved) {
  static const auto next = NextOf<decltype(&grpc_completion_queue_next)>(&grpc_completion_queue_next);
  const grpc_event event = next(queue, deadline, reserved);
  if (event.type == GRPC_OP_COMPLETE) Acquire(event.tag);
  return event;
}

grpc_event grpc_completion_queue_pluck(grpc_completion_queue* queue, void* tag, gpr_timespec deadline, void* reserved) {
  static const auto next = NextOf<decltype(&grpc_completion_queue_pluck)>(&grpc_completion_queue_pluck);
  const grpc_event event = next(queue, tag, deadline, reserved);
  if (event.type == GRPC_OP_COMPLETE) Acquire(tag);
  return event;
}

}  // extern "C"
