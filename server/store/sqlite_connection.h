#ifndef ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_

#include <sqlite3.h>

#include <memory>
#include <string>

#include "server/base/clock.h"
#include "server/store/sql_connection.h"
#include "server/store/statement_pool.h"

namespace rollgait::server {

class SqliteStatement;

// A connection to an SQLite file. Its lease clock is the machine's time since boot.
class SqliteConnection : public SqlConnection {
 public:
  // Opens or creates the file in WAL mode with synchronous=FULL; waits up to five seconds for other writers. Throws.
  // The clock outlives it.
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

  const Clock& clock_;
  sqlite3* handle_ = nullptr;
  StatementPool<SqliteStatement> statements_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_
