#ifndef ROLLGAIT_SERVER_BASE_NOTIFY_H_
#define ROLLGAIT_SERVER_BASE_NOTIFY_H_

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/base/hint_channel.h"
#include "server/base/outcome.h"
#include "server/base/socket_file.h"

namespace rollgait::server {

// Hints between rollgaitd and its agent: short texts (the id of a solve) as datagrams on Unix sockets in the data
// directory. A hint says "look into the store now"; it may be lost (no receiver, full buffer), so whoever waits for one
// also looks into the store every kNotifyPollMillis by itself.
inline constexpr int kNotifyPollMillis = 200;

// Longest text of one hint in bytes; longer ones are cut.
inline constexpr size_t kNotifyMaxBytes = 128;

// Receiving end. One thread uses it; movable. Removes its socket file on destruction only if the file is still its own.
class NotifyReceiver {
 public:
  // Binds `directory`/`name`, replacing a socket file that is left of a dead process (or of one that is to be
  // succeeded). Works for directories of any path length. kUnavailable with the reason if the directory cannot be used.
  static Outcome<NotifyReceiver> Create(const std::string& directory, const std::string& name);
  NotifyReceiver(NotifyReceiver&& other) noexcept;
  NotifyReceiver& operator=(NotifyReceiver&& other) noexcept;
  ~NotifyReceiver();

  // To poll for reading.
  int fd() const { return fd_; }
  // Everything received so far, oldest first, equal texts once. Never blocks.
  std::vector<std::string> Drain();

 private:
  NotifyReceiver(int fd, SocketFile file) : fd_(fd), file_(std::move(file)) {}
  void Close();

  int fd_ = -1;
  SocketFile file_;
};

// Sending end. Any number of threads may share it. Immutable.
class NotifySender {
 public:
  // Sends to whoever has bound `directory`/`name` at the time of Send. kUnavailable if the directory cannot be opened.
  static Outcome<NotifySender> Create(const std::string& directory, const std::string& name);
  NotifySender(NotifySender&& other) noexcept;
  NotifySender& operator=(NotifySender&& other) noexcept;
  ~NotifySender();

  // Sends a hint. Never blocks, never fails: see above. False if nobody took it.
  bool Send(std::string_view text) const;

 private:
  NotifySender(int fd, int directory_fd, std::string name)
      : fd_(fd), directory_fd_(directory_fd), name_(std::move(name)) {}
  void Close();

  int fd_ = -1;
  int directory_fd_ = -1;
  std::string name_;
};

// Both ends of one process in the data directory.
class SocketHints : public HintChannel {
 public:
  // kUnavailable with the reason.
  static Outcome<std::unique_ptr<HintChannel>> Create(const std::string& directory, const std::string& own_name,
                                                      const std::string& other_name);

  int fd() const override { return receiver_.fd(); }
  std::vector<std::string> Drain() override { return receiver_.Drain(); }
  void Send(std::string_view text) override { sender_.Send(text); }

 private:
  SocketHints(NotifyReceiver receiver, NotifySender sender)
      : receiver_(std::move(receiver)), sender_(std::move(sender)) {}

  NotifyReceiver receiver_;
  const NotifySender sender_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_NOTIFY_H_
