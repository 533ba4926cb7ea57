#ifndef ROLLGAIT_SERVER_STORE_POSTGRES_CONNECTION_H_
#define ROLLGAIT_SERVER_STORE_POSTGRES_CONNECTION_H_

#include <libpq-fe.h>

#include <map>
#include <memory>
#include <string>

#include "server/store/sql_connection.h"

namespace rollgait::server {

// Connects with our defaults (read-write host, time limits, keepalives; the URL may say otherwise). The connection has
// status CONNECTION_BAD if that failed; never null.
PGconn* ConnectPostgres(const std::string& url, const char* application_name);

// A connection to PostgreSQL. Its lease clock is the database's.
class PostgresConnection : public SqlConnection {
 public:
  // Throws. A session commits durably whatever the server's default of synchronous_commit.
  explicit PostgresConnection(const std::string& url);
  PostgresConnection(const PostgresConnection&) = delete;
  PostgresConnection& operator=(const PostgresConnection&) = delete;
  ~PostgresConnection() override;

  SqlStatement& Prepared(const char* sql) override;
  void Execute(const std::string& sql) override;
  void Begin(Access access) override;
  void Commit() override;
  void Rollback() noexcept override;
  bool lost() const override { return lost_ || PQstatus(handle_) == CONNECTION_BAD; }
  LeaseTime Now() override;
  void BeginSchemaChange() override;
  void EndSchemaChange() noexcept override {}
  bool HasSchema() override;

  // Throws unless the result is good; frees it then. Takes null.
  void Check(PGresult* result, const char* sql);

 private:
  void Run(const char* sql);

  PGconn* handle_;
  bool lost_ = false;
  std::map<const char*, std::unique_ptr<SqlStatement>> statements_;  // by address of the literal
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_POSTGRES_CONNECTION_H_
