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
    kUnknown,      // a commit was asked for and not answered: it may have happened, or may happen yet
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

// A prepared statement of one connection, in one run at a time. Parameters count from 1, columns from 0. All but Reset
// throw.
class SqlStatement {
 public:
  virtual ~SqlStatement() = default;
  virtual void Bind(int index, int64_t value) = 0;
  virtual void Bind(int index, double value) = 0;
  virtual void Bind(int index, const std::string& text) = 0;
  virtual void Bind(int index, const Blob& blob) = 0;
  // All is bound, and Step will follow or not. An engine that is far away is asked now and answers with the first Step
  // of any statement: so questions that are put before the first of them is read cost one wait together.
  virtual void Ask() = 0;
  // All is bound, and nobody wants to see the answer: the statement takes effect after those before it and before those
  // after it, and fails (the transaction with it) at once, with a later Step, or with Commit. Resets.
  virtual void Defer() = 0;
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

// One connection to a database engine. One thread at a time. SQL is written for both engines, with `?` for parameters;
// what differs between them are words in braces (sql_dialect.h). All but Rollback throw SqlFailure.
class SqlConnection {
 public:
  enum class Access {
    kOne,    // a single query that changes nothing: without a transaction around it
    kRead,   // one snapshot for several queries
    kWrite,  // SQLite: the writer's lock at once. PostgreSQL: READ COMMITTED, rows are locked by {for_update}
  };
  enum class LockMode { kShared, kExclusive };
  virtual ~SqlConnection() = default;

  // A statement for a literal (known by its address) that is not in use until it is reset; prepared once.
  virtual SqlStatement& Prepared(const char* sql) = 0;
  // Runs statements that return nothing.
  virtual void Execute(const std::string& sql) = 0;
  virtual void Begin(Access access) = 0;
  // Durable when it returns.
  virtual void Commit() = 0;
  virtual void Rollback() noexcept = 0;
  // True: of no use any more.
  virtual bool lost() const = 0;
  // True: lost because an answer did not come in time, and it is still due. Asks the engine, without waiting.
  virtual bool AnswerDue() noexcept = 0;

  // Holds the lock of this name to the end of the transaction: alone, or with others that share it. The next Step may
  // wait for it. Nothing where one writer at a time has the whole database.
  virtual void Lock(const std::string& name, LockMode mode) = 0;
  // Most transactions that can write at the same time, of all processes.
  virtual int MostWriters() const = 0;
  // A transaction that may rebuild tables, one at a time of all processes; ended by Commit or Rollback and then
  // EndSchemaChange.
  virtual void BeginSchemaChange() = 0;
  virtual void EndSchemaChange() noexcept = 0;
  // Whether the table schema_version is there.
  virtual bool HasSchema() = 0;
};

// One run of a prepared statement: Query(connection, "... ? ... ?", text, number).Step(). The text must be a literal.
// Queries made one after the other before the first Step share its wait.
class Query {
 public:
  template <typename... Values>
  Query(SqlConnection& connection, const char* sql, const Values&... values) : statement_(connection.Prepared(sql)) {
    Set(values...);
    statement_.Ask();
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  ~Query() { statement_.Reset(); }

  bool Step() { return statement_.Step(); }
  // Runs to the end and returns the number of rows changed.
  int Run() {
    while (statement_.Step()) continue;
    return statement_.changes();
  }
  // Runs a statement whose answer nobody wants; see SqlStatement::Defer.
  template <typename... Values>
  static void Do(SqlConnection& connection, const char* sql, const Values&... values) {
    Query query(connection.Prepared(sql));
    query.Set(values...);
    query.statement_.Defer();
  }
  int64_t Int(int column) const { return statement_.Int(column); }
  double Double(int column) const { return statement_.Double(column); }
  std::string Bytes(int column) const { return statement_.Bytes(column); }

 private:
  explicit Query(SqlStatement& statement) : statement_(statement) {}

  template <typename... Values>
  void Set(const Values&... values) {
    int index = 0;
    (BindValue(++index, values), ...);
  }
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
