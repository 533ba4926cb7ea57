#include "server/store/retention_task.h"

#include <spdlog/spdlog.h>

namespace rollgait::server {

RetentionTask::RetentionTask(SolveStore& store, const RetentionLimits& limits, std::chrono::milliseconds interval,
                             const Clock& clock, std::chrono::nanoseconds settle)
    : store_(store), limits_(limits), interval_(interval), clock_(clock, settle) {
  if (limits_.any()) thread_ = std::thread([this] { Loop(); });
}

RetentionTask::~RetentionTask() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool RetentionTask::Pause(std::chrono::milliseconds time) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !wake_.wait_for(lock, time, [this] { return stopping_; });
}

void RetentionTask::Clean() {
  Removed all;
  while (true) {
    const Outcome<Removed> removed = store_.Retain(clock_.Look() ? limits_ : limits_.WithoutAges());
    if (!removed.ok()) spdlog::warn("retention waits: {}", removed.error().message);
    if (!removed.ok() || !removed.value().any()) break;
    all.solves += removed.value().solves;
    all.event_logs += removed.value().event_logs;
    all.audit_rows += removed.value().audit_rows;
    if (!Pause(std::chrono::milliseconds(20))) break;
  }
  if (all.any()) {
    spdlog::info("retention removed {} solves, {} event logs, {} audit rows", all.solves, all.event_logs,
                 all.audit_rows);
  }
}

void RetentionTask::Loop() {
  do {
    Clean();
  } while (Pause(interval_));
}

}  // namespace rollgait::server
