#ifndef ROLLGAIT_TESTS_SCHEDULES_FAULTY_CONNECTION_H_
#define ROLLGAIT_TESTS_SCHEDULES_FAULTY_CONNECTION_H_

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/store/sql_connection.h"
#include "server/store/statement_pool.h"
#include "tests/schedules/scheduler.h"

namespace rollgait::server {

// Thrown through the code of a process at the statement where it dies. No std::exception: nobody handles it but who
// started the process.
struct Crashed {};

// One life of a program.
struct Process {
  bool dead = false;  // it does nothing more
  VirtualTime cut_off_until = 0;
};

// Probabilities, of each statement or commit.
struct FaultRates {
  double yield = 1;            // another actor may run between this statement and the next
  double crash = 0;            // the process dies here
  double lose = 0;             // the connection is lost
  double slow = 0;             // the disk takes up to four seconds
  double unanswered = 0;       // the commit happens, and its answer is lost
  double undone = 0;           // the commit does not happen, and its answer is lost too
  double crash_at_commit = 0;  // the process dies right after the commit
};

// Of an engine with one writer at a time.
struct WriterLock {
  const void* holder = nullptr;
  std::vector<Scheduler::ActorId> waiting;
};

// What the connections of one process share.
struct Site {
  Scheduler* scheduler = nullptr;
  std::shared_ptr<Process> process;  // null: none yet, and no faults
  const FaultRates* rates = nullptr;
  WriterLock* lock = nullptr;        // null: the engine locks rows
  std::function<void()> committed;   // called after each commit of a transaction that may write
  std::function<void()> keep_time;   // called before each statement
  bool events_after_commit = false;  // a planted bug: events are written in a transaction of their own, afterwards
  bool oldest_first = false;         // a planted bug: a claim takes the oldest solve, whosever it is
  bool one_queue = false;            // a planted bug: a claim takes the solve of the highest priority, whosever it is
};

class FaultyStatement;

// A connection where others run between any two statements and faults happen, as the scheduler's numbers say.
class FaultyConnection : public SqlConnection {
 public:
  using Returned = std::function<void(std::unique_ptr<SqlConnection>)>;
  // `returned` gets the inner connection in the end. The site outlives this.
  FaultyConnection(Site& site, std::unique_ptr<SqlConnection> inner, Returned returned);
  ~FaultyConnection() override;

  SqlStatement& Prepared(const char* sql) override;
  void Execute(const std::string& sql) override { inner_->Execute(sql); }
  void Begin(Access access) override;
  void Commit() override;
  void Rollback() noexcept override;
  bool lost() const override { return lost_ || inner_->lost(); }
  bool AnswerDue() noexcept override { return inner_->AnswerDue(); }
  void Lock(const std::string& name, LockMode mode) override { inner_->Lock(name, mode); }
  int MostWriters() const override { return inner_->MostWriters(); }
  void BeginSchemaChange() override { inner_->BeginSchemaChange(); }
  void EndSchemaChange() noexcept override { inner_->EndSchemaChange(); }
  bool HasSchema() override { return inner_->HasSchema(); }

  // Before a statement: others run, or a fault happens.
  void Pause(const char* sql);
  // Runs what may meet a lock of another transaction.
  template <typename Call>
  auto Guard(Call call) -> decltype(call());
  // True: the statement is kept for after the commit.
  bool HoldBack(const char* sql, SqlStatement& statement);

 private:
  [[noreturn]] void Die(Process& process, const char* where);
  void ThrowIfDead(const Process& process);
  void Clean() noexcept;
  void TakeLock();
  void ReleaseLock() noexcept;
  void WriteHeldBack();

  Site& site_;
  std::unique_ptr<SqlConnection> inner_;
  const Returned returned_;
  StatementPool<FaultyStatement> statements_;
  Access access_ = Access::kOne;
  bool lost_ = false, met_lock_ = false;
  std::vector<SqlStatement*> held_back_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_FAULTY_CONNECTION_H_
