#ifndef ROLLGAIT_BENCH_DELAYED_SOCKET_H_
#define ROLLGAIT_BENCH_DELAYED_SOCKET_H_

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace rollgait {

// Stands before a Unix socket like a network: whatever is sent to the socket `path` arrives at `target`, and the
// answers come back, each way so much later. As fast as it is asked, whatever the amount.
class DelayedSocket {
 public:
  DelayedSocket(const std::string& path, const std::string& target, std::chrono::microseconds each_way);
  DelayedSocket(const DelayedSocket&) = delete;
  DelayedSocket& operator=(const DelayedSocket&) = delete;
  ~DelayedSocket();

 private:
  void Loop();

  const std::string target_;
  const std::chrono::microseconds each_way_;
  int listener_ = -1;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_BENCH_DELAYED_SOCKET_H_
