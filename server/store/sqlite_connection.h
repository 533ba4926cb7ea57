#ifndef ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_

#include <sqlite3.h>

#include <chrono>
#include <memory>
#include <string>

#include "server/base/clock.h"
#include "server/store/sql_connection.h"
#include "server/store/statement_pool.h"
#include "server/store/write_turn.h"

namespace rollgait::server {

class SqliteStatement;

// A connection to an SQLite file. Its lease clock is the machine's time since boot.
class SqliteConnection : public SqlConnection {
 public:
  // Opens or creates the file in WAL mode with synchronous=FULL; waits up to five seconds for other writers, which
  // take turns (write_turn.h). Throws. The clock outlives it.
  SqliteConnection(const std::string& path, const Clock& clock);
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;
  ~SqliteConnection() override;

  SqlStatement& Prepared(const char* sql) override;
  void Execute(const std::string& sql) override;
  void Begin(Access access) override;
  void Commit() override;
  void Rollback() noexcept override;
  bool lost() const override { return false; }
  bool AnswerDue() noexcept override { return false; }
  void Lock(const std::string&, LockMode) override {}
  int MostWriters() const override { return 1; }
  void BeginSchemaChange() override;
  void EndSchemaChange() noexcept override;
  bool HasSchema() override;

  [[noreturn]] void Throw(const std::string& sql) const;

 private:
  // {boot_id} and {now_ns} of sqlite_dialect.cc.
  void AddClockFunctions();
  // SQLite's busy handler: waits before it looks again at a lock; 0: too long.
  static int LookAgain(void* connection, int looks);

  const Clock& clock_;
  WriteTurn turn_;
  std::chrono::steady_clock::time_point give_up_;  // a lock that is waited for
  sqlite3* handle_ = nullptr;
  StatementPool<SqliteStatement> statements_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_
