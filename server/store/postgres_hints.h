#ifndef ROLLGAIT_SERVER_STORE_POSTGRES_HINTS_H_
#define ROLLGAIT_SERVER_STORE_POSTGRES_HINTS_H_

#include <libpq-fe.h>

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/base/hint_channel.h"

namespace rollgait::server {

// Hints by LISTEN and NOTIFY. A thread owns the connection, makes it again when it is lost, and drops what cannot be
// sent meanwhile.
class PostgresHints : public HintChannel {
 public:
  // Listens on one channel and sends to others; names are identifiers of our own.
  PostgresHints(std::string url, std::string listen, std::vector<std::string> send);
  ~PostgresHints() override;

  int fd() const override { return received_fd_; }
  std::vector<std::string> Drain() override;
  void Send(std::string_view text) override;
  // True once it listens (again). What is sent before may be missed.
  bool listening() const { return listening_; }

 private:
  void Loop();
  bool Connect();
  void Receive();
  bool SendWaiting();
  void Disconnect();
  void Pause();

  const std::string url_, listen_;
  const std::vector<std::string> send_;
  const int received_fd_, wake_fd_;
  std::atomic<bool> stopping_{false}, listening_{false};
  PGconn* handle_ = nullptr;  // of the thread
  std::mutex mutex_;          // protects what follows
  std::vector<std::string> received_, waiting_;
  std::thread thread_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_POSTGRES_HINTS_H_
