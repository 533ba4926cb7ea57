#include "tests/schedules/faulty_connection.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

using FailureKind = SqlFailure::Kind;

constexpr VirtualTime kLongestWait = 5 * kSecond;         // for the writer's lock, as SqliteConnection waits
constexpr VirtualTime kSlowest = 4 * kSecond;             // of a statement
constexpr VirtualTime kLongestPause = 50 * kMillisecond;  // after a conflict

// The claim without turns, in this order; other statements as they are. As a literal, which is known by its address.
const char* WithoutTurns(const char* sql, const std::string& order) {
  static std::map<std::string, std::string> changed;
  const std::string text = sql;
  const size_t tenant = text.find("AND tenant = (WITH RECURSIVE"), end = text.find("AND (solve_key = ''");
  if (tenant == std::string::npos || end == std::string::npos) return sql;
  std::string one_queue = text.substr(0, tenant) + text.substr(end);
  const std::string usual = "ORDER BY priority DESC, number";
  one_queue.replace(one_queue.find(usual), usual.size(), order);
  return changed.emplace(order, one_queue).first->second.c_str();
}

}  // namespace

template <typename Call>
auto FaultyConnection::Guard(Call call) -> decltype(call()) {
  try {
    return call();
  } catch (const SqlFailure& failure) {
    // Nobody else runs while the engine waits, so it waits in vain; another attempt may find the lock free.
    if (std::strstr(failure.what(), "lock timeout") == nullptr) throw;
    met_lock_ = true;
    throw SqlFailure(FailureKind::kConflict, failure.what());
  }
}

// Forwards to a statement of the inner connection.
class FaultyStatement : public SqlStatement {
 public:
  FaultyStatement(FaultyConnection& connection, const char* sql) : connection_(connection), sql_(sql) {}

  void Bind(int index, int64_t value) override { inner_->Bind(index, value); }
  void Bind(int index, double value) override { inner_->Bind(index, value); }
  void Bind(int index, const std::string& text) override { inner_->Bind(index, text); }
  void Bind(int index, const Blob& blob) override { inner_->Bind(index, blob); }
  void Ask() override {
    inner_->Ask();
    answered_ = false;
  }
  void Defer() override {
    connection_.Pause(sql_);
    if (connection_.HoldBack(sql_, *inner_)) {
      inner_ = nullptr;
    } else {
      connection_.Guard([&] { inner_->Defer(); });
    }
    Reset();
  }
  bool Step() override {
    if (!std::exchange(answered_, true)) connection_.Pause(sql_);
    return connection_.Guard([&] { return inner_->Step(); });
  }
  int64_t Int(int column) const override { return inner_->Int(column); }
  double Double(int column) const override { return inner_->Double(column); }
  std::string Bytes(int column) const override { return inner_->Bytes(column); }
  int changes() const override { return inner_->changes(); }
  void Reset() noexcept override {
    if (inner_ != nullptr) inner_->Reset();
    inner_ = nullptr;
  }
  bool in_use() const { return inner_ != nullptr; }
  void MarkInUse() {}
  void Use(SqlStatement& inner) { inner_ = &inner; }

 private:
  FaultyConnection& connection_;
  const char* const sql_;
  SqlStatement* inner_ = nullptr;
  bool answered_ = false;
};

FaultyConnection::FaultyConnection(Site& site, std::unique_ptr<SqlConnection> inner, Returned returned)
    : site_(site), inner_(std::move(inner)), returned_(std::move(returned)) {}

FaultyConnection::~FaultyConnection() {
  ReleaseLock();
  statements_.Clear();
  if (lost_ && !inner_->lost()) Clean();
  returned_(std::move(inner_));
}

// The inner connection is used again, unlike one that is lost: ends what was asked and not answered.
void FaultyConnection::Clean() noexcept {
  inner_->Rollback();
  try {
    inner_->Execute("SELECT 1");
  } catch (const SqlFailure&) {  // of what was asked
  }
}

SqlStatement& FaultyConnection::Prepared(const char* sql) {
  if (site_.oldest_first) sql = WithoutTurns(sql, "ORDER BY number");
  if (site_.one_queue) sql = WithoutTurns(sql, "ORDER BY priority DESC, number");
  FaultyStatement& statement = statements_.Take(sql, [&] { return std::make_unique<FaultyStatement>(*this, sql); });
  statement.Use(inner_->Prepared(sql));
  return statement;
}

// Nobody uses the connections of a dead process again.
void FaultyConnection::ThrowIfDead(const Process& process) {
  if (!process.dead) return;
  lost_ = true;
  throw Crashed{};
}

void FaultyConnection::Die(Process& process, const char* where) {
  site_.scheduler->Note(where);
  process.dead = true;
  site_.scheduler->WakeAll();
  ThrowIfDead(process);
  std::abort();
}

void FaultyConnection::Pause(const char* sql) {
  if (site_.process == nullptr) return;  // the tables are made
  // Of this life; the site may be another's when it goes on.
  const std::shared_ptr<Process> process = site_.process;
  if (process->dead) throw SqlFailure(FailureKind::kUnavailable, "the process has died");
  Scheduler& scheduler = *site_.scheduler;
  SeededNumbers& random = scheduler.random();
  const FaultRates& rates = *site_.rates;
  if (scheduler.traced()) scheduler.Note(std::string(sql).substr(0, 60));
  if (random.Chance(rates.crash)) Die(*process, "dies here");
  if (random.Chance(rates.slow)) {
    const VirtualTime taken = random.Between(0, kSlowest);
    if (scheduler.traced()) scheduler.Note("the disk takes " + std::to_string(taken / kMillisecond) + " ms");
    scheduler.Freeze(taken);
  } else if (random.Chance(rates.yield)) {
    scheduler.Yield();
  }
  ThrowIfDead(*process);
  site_.keep_time();
  if (random.Chance(rates.lose) || scheduler.now() < process->cut_off_until) {
    scheduler.Note("its connection is lost");
    lost_ = true;
    throw SqlFailure(FailureKind::kLost, "the connection is gone");
  }
}

void FaultyConnection::TakeLock() {
  if (site_.lock == nullptr) return;
  const std::shared_ptr<Process> process = site_.process;
  Scheduler& scheduler = *site_.scheduler;
  const VirtualTime end = scheduler.now() + kLongestWait;
  while (site_.lock->holder != nullptr) {
    if (scheduler.now() >= end) throw SqlFailure(FailureKind::kUnavailable, "database is locked");
    site_.lock->waiting.push_back(scheduler.current());
    scheduler.SleepUntil(end);
    ThrowIfDead(*process);
  }
  site_.lock->holder = this;
}

void FaultyConnection::ReleaseLock() noexcept {
  if (site_.lock == nullptr || site_.lock->holder != this) return;
  site_.lock->holder = nullptr;
  for (const Scheduler::ActorId actor : site_.lock->waiting) site_.scheduler->Wake(actor);
  site_.lock->waiting.clear();
}

void FaultyConnection::Begin(Access access) {
  const std::shared_ptr<Process> process = site_.process;
  Pause(access == Access::kWrite ? "BEGIN, to write" : "BEGIN, to read");
  if (std::exchange(met_lock_, false)) site_.scheduler->Sleep(site_.scheduler->random().Between(0, kLongestPause));
  ThrowIfDead(*process);
  access_ = access;
  if (access == Access::kWrite) TakeLock();
  inner_->Begin(access);
}

void FaultyConnection::Commit() {
  if (access_ != Access::kWrite) return inner_->Commit();
  const std::shared_ptr<Process> process = site_.process;
  Pause("COMMIT");
  Scheduler& scheduler = *site_.scheduler;
  SeededNumbers& random = scheduler.random();
  const FaultRates& rates = *site_.rates;
  if (random.Chance(rates.undone)) {
    scheduler.Note("the commit does not happen, and nobody says so");
    lost_ = true;
    throw SqlFailure(FailureKind::kUnknown, "no answer");
  }
  Guard([&] { inner_->Commit(); });
  ReleaseLock();
  site_.committed();
  if (random.Chance(rates.crash_at_commit)) Die(*process, "dies after the commit");
  if (!held_back_.empty()) WriteHeldBack();
  if (random.Chance(rates.unanswered)) {
    scheduler.Note("the answer to the commit is lost");
    lost_ = true;
    throw SqlFailure(FailureKind::kUnknown, "no answer");
  }
  if (random.Chance(rates.yield)) scheduler.Yield();
  ThrowIfDead(*process);
}

void FaultyConnection::Rollback() noexcept {
  for (SqlStatement* statement : held_back_) statement->Reset();
  held_back_.clear();
  inner_->Rollback();
  ReleaseLock();
}

bool FaultyConnection::HoldBack(const char* sql, SqlStatement& statement) {
  if (!site_.events_after_commit || std::strncmp(sql, "INSERT INTO events", 18) != 0) return false;
  held_back_.push_back(&statement);
  return true;
}

void FaultyConnection::WriteHeldBack() {
  inner_->Begin(Access::kWrite);
  for (SqlStatement* statement : std::exchange(held_back_, {})) statement->Defer();
  inner_->Commit();
  site_.committed();
}

}  // namespace rollgait::server
