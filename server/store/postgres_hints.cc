#include "server/store/postgres_hints.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "core/base/check.h"
#include "server/store/postgres_connection.h"

namespace rollgait::server {
namespace {

constexpr int kRetryMillis = 500, kTickMillis = 50;
constexpr size_t kMostWaiting = 10'000;

void Ring(int fd) {
  const uint64_t one = 1;
  ROLLGAIT_CHECK(write(fd, &one, sizeof one) == sizeof one);
}

void Silence(int fd) {
  uint64_t count = 0;
  [[maybe_unused]] const ssize_t size = read(fd, &count, sizeof count);  // nobody may have rung
}

void AddOnce(std::vector<std::string>& texts, std::string text) {
  if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(std::move(text));
}

}  // namespace

PostgresHints::PostgresHints(std::string url, std::string listen, std::vector<std::string> send)
    : url_(std::move(url)),
      listen_(std::move(listen)),
      send_(std::move(send)),
      received_fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      wake_fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  ROLLGAIT_CHECK(received_fd_ >= 0 && wake_fd_ >= 0);
  thread_ = std::thread([this] { Loop(); });
}

PostgresHints::~PostgresHints() {
  stopping_ = true;
  Ring(wake_fd_);
  thread_.join();
  close(received_fd_);
  close(wake_fd_);
}

std::vector<std::string> PostgresHints::Drain() {
  Silence(received_fd_);
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(received_, {});
}

void PostgresHints::Send(std::string_view text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() >= kMostWaiting) return;
    AddOnce(waiting_, std::string(text));
  }
  Ring(wake_fd_);
}

bool PostgresHints::Connect() {
  handle_ = ConnectPostgres(url_, "rollgait hints");
  if (PQstatus(handle_) == CONNECTION_OK) {
    // A hint needs no disk: it is worth nothing after a crash.
    PGresult* result = PQexec(handle_, ("SET synchronous_commit = off; LISTEN " + listen_).c_str());
    listening_ = PQresultStatus(result) == PGRES_COMMAND_OK;
    PQclear(result);
  }
  if (!listening_) Disconnect();
  return listening_;
}

void PostgresHints::Disconnect() {
  listening_ = false;
  PQfinish(std::exchange(handle_, nullptr));
}

void PostgresHints::Receive() {
  bool any = false;
  while (PGnotify* notify = PQnotifies(handle_)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    AddOnce(received_, notify->extra);
    PQfreemem(notify);
    any = true;
  }
  if (any) Ring(received_fd_);
}

bool PostgresHints::SendWaiting() {
  std::vector<std::string> waiting;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting.swap(waiting_);
  }
  if (waiting.empty()) return true;
  std::string ids;
  for (const std::string& id : waiting) ids += (ids.empty() ? "" : ",") + id;
  for (const std::string& channel : send_) {
    const char* values[] = {channel.c_str(), ids.c_str()};
    PGresult* result =
        PQexecParams(handle_, "SELECT pg_notify($1::text, id) FROM unnest(string_to_array($2::text, ',')) AS id", 2,
                     nullptr, values, nullptr, nullptr, 0);
    const bool sent = PQresultStatus(result) == PGRES_TUPLES_OK;
    PQclear(result);
    if (!sent) return false;
  }
  return true;
}

// Before the next attempt to connect. What nobody could hear is dropped.
void PostgresHints::Pause() {
  for (int waited = 0; waited < kRetryMillis && !stopping_; waited += kTickMillis) poll(nullptr, 0, kTickMillis);
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.clear();
}

void PostgresHints::Loop() {
  while (!stopping_) {
    if (handle_ == nullptr && !Connect()) {
      Pause();
      continue;
    }
    if (!SendWaiting() || PQconsumeInput(handle_) == 0) {
      spdlog::warn("the connection for hints is lost and made again");
      Disconnect();
      continue;
    }
    Receive();
    pollfd entries[] = {{PQsocket(handle_), POLLIN, 0}, {wake_fd_, POLLIN, 0}};
    poll(entries, 2, -1);
    Silence(wake_fd_);
  }
  if (handle_ != nullptr) Disconnect();
}

}  // namespace rollgait::server
