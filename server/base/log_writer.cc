#include "server/base/log_writer.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

namespace rollgait::server {
namespace {

// A descriptor that takes nothing any more (EPIPE) loses the line: there is no other place to say so.
void WriteAll(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(fd, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) {  // somebody who shares the descriptor made it non-blocking
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    if (count <= 0) return;
    text.remove_prefix(static_cast<size_t>(count));
  }
}

}  // namespace

struct LogWriter::Queue {
  explicit Queue(Options from) : options(std::move(from)) {}

  const Options options;
  std::mutex mutex;  // protects what follows
  std::condition_variable filled, written;
  std::deque<std::string> lines;
  size_t bytes = 0;               // of lines
  int64_t given = 0, done = 0;    // lines handed over; lines written or dropped
  int64_t dropped = 0, told = 0;  // told: of the dropped ones, those that a line in the log has counted
  bool ending = false;
};

LogWriter::LogWriter(Options options) : queue_(std::make_shared<Queue>(std::move(options))) {
  // Signals are for the threads that wait for them.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([queue = queue_] { Run(*queue); }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

LogWriter::~LogWriter() {
  Flush(kEndWait);
  const std::lock_guard<std::mutex> lock(queue_->mutex);
  queue_->ending = true;
  queue_->filled.notify_all();
}

void LogWriter::Write(std::string line) {
  const std::lock_guard<std::mutex> lock(queue_->mutex);
  queue_->bytes += line.size();
  queue_->lines.push_back(std::move(line));
  ++queue_->given;
  while (queue_->bytes > queue_->options.most_bytes && queue_->lines.size() > 1) {
    queue_->bytes -= queue_->lines.front().size();
    queue_->lines.pop_front();
    ++queue_->done;
    ++queue_->dropped;
  }
  queue_->filled.notify_one();
}

bool LogWriter::Flush(std::chrono::milliseconds at_most) {
  std::unique_lock<std::mutex> lock(queue_->mutex);
  const int64_t until = queue_->given;
  return queue_->written.wait_for(lock, at_most, [&] { return queue_->done >= until; });
}

int64_t LogWriter::dropped() const {
  const std::lock_guard<std::mutex> lock(queue_->mutex);
  return queue_->dropped;
}

void LogWriter::Run(Queue& queue) {
  std::unique_lock<std::mutex> lock(queue.mutex);
  while (true) {
    queue.filled.wait(lock, [&] { return queue.ending || !queue.lines.empty(); });
    if (queue.ending) return;
    const int64_t untold = queue.dropped - std::exchange(queue.told, queue.dropped);
    const std::string line = std::move(queue.lines.front());
    queue.lines.pop_front();
    queue.bytes -= line.size();
    lock.unlock();
    if (untold > 0 && queue.options.dropped_line) WriteAll(queue.options.fd, queue.options.dropped_line(untold));
    WriteAll(queue.options.fd, line);
    lock.lock();
    ++queue.done;
    queue.written.notify_all();
  }
}

}  // namespace rollgait::server
