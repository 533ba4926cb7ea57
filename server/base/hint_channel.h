#ifndef ROLLGAIT_SERVER_BASE_HINT_CHANNEL_H_
#define ROLLGAIT_SERVER_BASE_HINT_CHANNEL_H_

#include <string>
#include <string_view>
#include <vector>

namespace rollgait::server {

// How the processes that work on one store tell each other to look into it: short texts (the id of a solve). A hint may
// be lost, so whoever waits for one also looks into the store by itself every kNotifyPollMillis (notify.h).
class HintChannel {
 public:
  virtual ~HintChannel() = default;

  // To poll for reading. One thread uses fd and Drain.
  virtual int fd() const = 0;
  // Everything received so far, oldest first, equal texts once. Never blocks.
  virtual std::vector<std::string> Drain() = 0;
  // Tells the other side. Never blocks, never fails. Any thread.
  virtual void Send(std::string_view text) = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_HINT_CHANNEL_H_
