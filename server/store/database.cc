#include "server/store/database.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <random>
#include <thread>
#include <utility>

#include "server/base/executor.h"
#include "server/store/schema.h"

namespace rollgait::server {
namespace {

using Kind = SqlFailure::Kind;

constexpr int kConflicts = 30;  // in a row, before a call gives up
constexpr int kLosses = 2;
constexpr std::chrono::seconds kWaitForConnection(10);

// Those that were in each other's way do not meet again at the same moment.
void PauseAfterConflict(int conflicts) {
  thread_local std::minstd_rand random(std::random_device{}());
  const int longest = std::min(20, 1 << std::min(conflicts, 5));
  std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution<>(0, longest)(random)));
}

Error ToError(const SqlFailure& failure) {
  switch (failure.kind()) {
    case Kind::kFull:
      return {ErrorCode::kResourceExhausted,
              std::string("the store has no room on its disk: ") + failure.what() +
                  "; nothing is lost, and it goes on by itself when there is room",
              {},
              std::chrono::milliseconds(10'000)};
    case Kind::kConflict:
    case Kind::kLost:
    case Kind::kUnavailable:
      return {ErrorCode::kUnavailable, std::string("the store cannot do this now: ") + failure.what()};
    case Kind::kUnknown:
      return {ErrorCode::kUnavailable,
              std::string(
                  "the store was asked to commit and did not answer, so this has happened, happens yet or does not: ") +
                  failure.what() + "; make the same call again, CreateSolve with its request_id"};
    case Kind::kInternal:
      break;
  }
  return {ErrorCode::kInternal, std::string("the store failed: ") + failure.what()};
}

}  // namespace

std::unique_ptr<SqlConnection> Database::Take(SqlConnection::Access access) {
  const bool write = access == SqlConnection::Access::kWrite;
  Pool& pool = write ? writers_ : readers_;
  const int most = write ? options_.writers : options_.readers;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    for (Pool* each : {&writers_, &readers_}) {
      std::erase_if(each->overdue, [](const auto& connection) { return !connection->AnswerDue(); });
    }
    // As many again as may be in use: enough for those of a host that is gone.
    if (static_cast<int>(pool.overdue.size()) >= 2 * most) {
      throw SqlFailure(Kind::kUnavailable,
                       std::to_string(pool.overdue.size()) + " earlier calls are still waiting for the database");
    }
    if (!returned_.wait_for(lock, kWaitForConnection, [&] { return !pool.idle.empty() || pool.open < most; })) {
      throw SqlFailure(Kind::kUnavailable, "all " + std::to_string(most) + " connections were busy for too long");
    }
    if (!pool.idle.empty()) {
      std::unique_ptr<SqlConnection> connection = std::move(pool.idle.back());
      pool.idle.pop_back();
      return connection;
    }
    ++pool.open;
  }
  try {
    return options_.connect();
  } catch (...) {
    Return(access, nullptr);
    throw;
  }
}

void Database::Return(SqlConnection::Access access, std::unique_ptr<SqlConnection> connection) {
  const bool due = connection != nullptr && connection->AnswerDue();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Pool& pool = access == SqlConnection::Access::kWrite ? writers_ : readers_;
    if (connection != nullptr && !connection->lost()) {
      pool.idle.push_back(std::move(connection));
    } else {
      --pool.open;
      if (due) pool.overdue.push_back(std::move(connection));
    }
  }
  returned_.notify_all();
}

// One lost connection is seldom the only one.
void Database::DropIdle() {
  std::vector<std::unique_ptr<SqlConnection>> dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (Pool* pool : {&writers_, &readers_}) {
      pool->open -= static_cast<int>(pool->idle.size());
      std::move(pool->idle.begin(), pool->idle.end(), std::back_inserter(dropped));
      pool->idle.clear();
    }
  }
  returned_.notify_all();
}

void Database::Alone(SqlConnection::Access access, Waiting& write) {
  std::unique_ptr<SqlConnection> connection;
  write.failure.reset();
  try {
    connection = Take(access);
    const bool single = access == SqlConnection::Access::kOne;
    if (!single) connection->Begin(access);
    if (write.body(*connection)) {
      if (!single) connection->Commit();
    } else {
      connection->Rollback();
    }
  } catch (const SqlFailure& failure) {
    if (connection != nullptr) connection->Rollback();
    write.failure = failure;
  } catch (...) {
    if (connection != nullptr) {
      connection->Rollback();
      Return(access, std::move(connection));
    }
    throw;
  }
  if (connection == nullptr) return;
  const bool lost = connection->lost();
  Return(access, std::move(connection));
  if (lost) DropIdle();
}

// All in one transaction, each undone by itself if it does not want to commit. False: something failed, nothing was
// written.
bool Database::TryTogether(const std::vector<Waiting*>& group) {
  constexpr SqlConnection::Access kWrite = SqlConnection::Access::kWrite;
  std::unique_ptr<SqlConnection> connection;
  bool committed = false;
  try {
    connection = Take(kWrite);
    connection->Begin(kWrite);
    for (const Waiting* write : group) {
      Query::Do(*connection, "SAVEPOINT one");
      if (!write->body(*connection)) Query::Do(*connection, "ROLLBACK TO one");
      Query::Do(*connection, "RELEASE one");
    }
    connection->Commit();
    committed = true;
  } catch (const SqlFailure&) {
    if (connection != nullptr) connection->Rollback();
  }
  if (connection != nullptr) Return(kWrite, std::move(connection));
  return committed;
}

void Database::RunGroup(const std::vector<Waiting*>& group) {
  if (group.size() > 1 && TryTogether(group)) return;
  for (Waiting* write : group) Alone(SqlConnection::Access::kWrite, *write);
}

// The first that finds nobody at work does the work of all that wait.
void Database::InGroup(Waiting& write) {
  std::unique_lock<std::mutex> lock(group_mutex_);
  waiting_.push_back(&write);
  group_done_.wait(lock, [&] { return write.done || !leading_; });
  if (write.done) return;
  leading_ = true;
  const std::vector<Waiting*> group = std::exchange(waiting_, {});
  lock.unlock();
  RunGroup(group);
  lock.lock();
  leading_ = false;
  for (Waiting* member : group) member->done = true;
  group_done_.notify_all();
}

Outcome<Done> Database::PrepareSchema() {
  constexpr SqlConnection::Access kWrite = SqlConnection::Access::kWrite;
  std::unique_ptr<SqlConnection> connection;
  try {
    connection = Take(kWrite);
    EnsureSchema(*connection);
  } catch (const SqlFailure& failure) {
    if (connection != nullptr) Return(kWrite, std::move(connection));
    return ToError(failure);
  }
  Return(kWrite, std::move(connection));
  return Done{};
}

std::optional<Error> Database::Transact(SqlConnection::Access access, const Body& body) {
  // A write waits for others and for the disk, far longer than it computes.
  std::optional<Executor::Blocked> blocked;
  if (access == SqlConnection::Access::kWrite) blocked.emplace();
  for (int conflicts = 0, losses = 0;;) {
    Waiting write{body};
    if (access == SqlConnection::Access::kWrite && options_.group_writes) {
      InGroup(write);
    } else {
      Alone(access, write);
    }
    if (!write.failure.has_value()) return std::nullopt;
    const SqlFailure& failure = *write.failure;
    if (failure.kind() == Kind::kLost && ++losses <= kLosses) continue;
    if (failure.kind() != Kind::kConflict || ++conflicts > kConflicts) return ToError(failure);
    PauseAfterConflict(conflicts);
  }
}

}  // namespace rollgait::server
