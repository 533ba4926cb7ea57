#ifndef ROLLGAIT_SERVER_STORE_POSTGRES_CONNECTION_H_
#define ROLLGAIT_SERVER_STORE_POSTGRES_CONNECTION_H_

#include <libpq-fe.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "server/store/postgres_pipeline.h"
#include "server/store/sql_connection.h"
#include "server/store/statement_pool.h"

namespace rollgait::server {

class PostgresStatement;

// Connects with our defaults (read-write host, time limits, keepalives; the URL may say otherwise). The connection has
// status CONNECTION_BAD if that failed; never null.
PGconn* ConnectPostgres(const std::string& url, const char* application_name);

// A connection to PostgreSQL. Its lease clock is the database's. Statements go out together: BEGIN and all that is
// deferred with the next one whose answer is read, the rest with COMMIT. So a transaction that reads, decides and
// writes waits twice.
class PostgresConnection : public SqlConnection {
 public:
  // How long an answer is waited for. A commit waits for synchronous standbys, and without limit if there is none.
  struct Limits {
    std::chrono::milliseconds answer{30'000}, commit{10'000};
  };
  explicit PostgresConnection(const std::string& url) : PostgresConnection(url, Limits{}) {}
  // Throws. A session commits durably whatever the server's default of synchronous_commit.
  PostgresConnection(const std::string& url, const Limits& limits);
  PostgresConnection(const PostgresConnection&) = delete;
  PostgresConnection& operator=(const PostgresConnection&) = delete;
  ~PostgresConnection() override;

  SqlStatement& Prepared(const char* sql) override;
  void Execute(const std::string& sql) override;
  void Begin(Access access) override;
  void Commit() override;
  void Rollback() noexcept override;
  bool lost() const override { return pipeline_.lost(); }
  bool AnswerDue() noexcept override { return pipeline_.AnswerDue(); }
  void Lock(const std::string& name, LockMode mode) override;
  int MostWriters() const override { return most_writers_; }
  void BeginSchemaChange() override;
  void EndSchemaChange() noexcept override {}
  bool HasSchema() override;

  int64_t round_trips() const { return pipeline_.round_trips(); }

 private:
  friend class PostgresStatement;
  enum class Transaction { kNone, kAsked, kOpen };  // kAsked: BEGIN goes along with the first statement

  struct Closer {
    void operator()(PGconn* handle) const { PQfinish(handle); }
  };

  void BeginIfAsked();
  // Sends a statement, and BEGIN before it if that is asked for.
  std::shared_ptr<PostgresRun> Send(PostgresPrepared& statement, const PostgresValues& values);
  void Settle() { pipeline_.Settle(limits_.answer); }
  PostgresPrepared& PreparedText(const char* sql);

  const Limits limits_;
  const std::unique_ptr<PGconn, Closer> handle_;
  PostgresPipeline pipeline_;
  std::map<const char*, PostgresPrepared> prepared_;  // by address of the literal
  StatementPool<PostgresStatement> statements_;
  Transaction transaction_ = Transaction::kNone;
  Access access_ = Access::kOne;
  int most_writers_ = 1;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_POSTGRES_CONNECTION_H_
