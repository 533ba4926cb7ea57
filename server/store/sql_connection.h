#ifndef ROLLGAIT_SERVER_STORE_SQL_CONNECTION_H_
#define ROLLGAIT_SERVER_STORE_SQL_CONNECTION_H_

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace rollgait::server {

// What a database answered when it could not do something. Thrown inside Database::Write and Read only, which turn it
// into an Error.
class SqlFailure : public std::runtime_error {
 public:
  enum class Kind {
    kConflict,     // another transaction was in the way: the same one may succeed at once
    kLost,         // the connection is gone
    kFull,         // no room on the database's disk
    kUnavailable,  // not now
    kInternal,
  };
  SqlFailure(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

// Bytes to bind as such; a plain string is bound as text. Refers to a string that outlives the binding call.
struct Blob {
  const std::string& bytes;
};

// A prepared statement of one connection. Parameters count from 1, columns from 0. All but Reset throw.
class SqlStatement {
 public:
  virtual ~SqlStatement() = default;
  virtual void Bind(int index, int64_t value) = 0;
  virtual void Bind(int index, double value) = 0;
  virtual void Bind(int index, const std::string& text) = 0;
  virtual void Bind(int index, const Blob& blob) = 0;
  // True if there is a row; false at the end.
  virtual bool Step() = 0;
  // Columns of the row. NULL reads as 0 or "".
  virtual int64_t Int(int column) const = 0;
  virtual double Double(int column) const = 0;
  virtual std::string Bytes(int column) const = 0;
  // Rows changed by the last run.
  virtual int changes() const = 0;
  virtual void Reset() noexcept = 0;
};

// A time that never jumps while boot_id stays the same, in every process that uses the database.
struct LeaseTime {
  std::string boot_id;
  int64_t ns = 0;
};

// One connection to a database engine. One thread at a time. SQL is written for both engines, with `?` for parameters;
// what differs between them are words in braces (sql_dialect.h). All but Rollback throw SqlFailure.
class SqlConnection {
 public:
  enum class Access {
    kOne,    // a single query that changes nothing: without a transaction around it
    kRead,   // one snapshot for several queries
    kWrite,  // SQLite: the writer's lock at once. PostgreSQL: READ COMMITTED, rows are locked by {for_update}
  };
  virtual ~SqlConnection() = default;

  // The statement for a literal (known by its address); prepared once.
  virtual SqlStatement& Prepared(const char* sql) = 0;
  // Runs statements that return nothing.
  virtual void Execute(const std::string& sql) = 0;
  virtual void Begin(Access access) = 0;
  // Durable when it returns.
  virtual void Commit() = 0;
  virtual void Rollback() noexcept = 0;
  // True: of no use any more.
  virtual bool lost() const = 0;

  // Leases expire by this clock.
  virtual LeaseTime Now() = 0;
  // A transaction that may rebuild tables, one at a time of all processes; ended by Commit or Rollback and then
  // EndSchemaChange.
  virtual void BeginSchemaChange() = 0;
  virtual void EndSchemaChange() noexcept = 0;
  // Whether the table schema_version is there.
  virtual bool HasSchema() = 0;
};

// One run of a prepared statement: Query(connection, "... ? ... ?", text, number).Step(). The text must be a literal.
class Query {
 public:
  template <typename... Values>
  Query(SqlConnection& connection, const char* sql, const Values&... values) : statement_(connection.Prepared(sql)) {
    int index = 0;
    (BindValue(++index, values), ...);
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  ~Query() { statement_.Reset(); }

  bool Step() { return statement_.Step(); }
  // Runs to the end and returns the number of rows changed.
  int Run() {
    while (statement_.Step()) {
    }
    return statement_.changes();
  }
  int64_t Int(int column) const { return statement_.Int(column); }
  double Double(int column) const { return statement_.Double(column); }
  std::string Bytes(int column) const { return statement_.Bytes(column); }

 private:
  void BindValue(int index, int64_t value) { statement_.Bind(index, value); }
  void BindValue(int index, int value) { statement_.Bind(index, int64_t{value}); }
  void BindValue(int index, bool value) { statement_.Bind(index, int64_t{value ? 1 : 0}); }
  void BindValue(int index, double value) { statement_.Bind(index, value); }
  void BindValue(int index, const std::string& text) { statement_.Bind(index, text); }
  void BindValue(int index, const char* text) { statement_.Bind(index, std::string(text)); }
  void BindValue(int index, const Blob& blob) { statement_.Bind(index, blob); }

  SqlStatement& statement_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQL_CONNECTION_H_
