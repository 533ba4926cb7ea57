#ifndef ROLLGAIT_SERVER_BASE_MEMORY_RETURN_H_
#define ROLLGAIT_SERVER_BASE_MEMORY_RETURN_H_

#include <condition_variable>
#include <mutex>
#include <thread>

namespace rollgait::server {

// While it lives, memory that the process has freed goes back to the kernel: a thread looks every 10 s, and where
// glibc's arenas hold more than 64 MiB free it calls malloc_trim. glibc alone keeps what a flood of calls needed for as
// long as anything above it in the heap lives: 11.8 GB were held for minutes, 28 MB after malloc_trim.
class MemoryReturn {
 public:
  MemoryReturn();
  ~MemoryReturn();
  MemoryReturn(const MemoryReturn&) = delete;
  MemoryReturn& operator=(const MemoryReturn&) = delete;

 private:
  void Loop();

  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_MEMORY_RETURN_H_
