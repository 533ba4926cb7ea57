#ifndef ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

namespace rollgait::server {

// What SQLite answered when it could not do something. Thrown inside server/store only; SqliteStore turns it into an
// Error.
class SqliteFailure : public std::runtime_error {
 public:
  SqliteFailure(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  // Primary result code, SQLITE_BUSY for example.
  int code() const { return code_; }

 private:
  int code_;
};

// One connection and its prepared statements. One thread at a time.
class SqliteConnection {
 public:
  // Opens or creates the file in WAL mode with synchronous=FULL; waits up to five seconds for other writers. Throws.
  explicit SqliteConnection(const std::string& path);
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;
  ~SqliteConnection();

  // Runs statements that return nothing. Throws.
  void Execute(const char* sql);
  // The statement for a literal; prepared once. Throws.
  sqlite3_stmt* Prepared(const char* sql);
  // Rows changed by the last statement.
  int changes() const { return sqlite3_changes(handle_); }
  int64_t last_row() const { return sqlite3_last_insert_rowid(handle_); }
  [[noreturn]] void Throw(const char* sql) const;

 private:
  sqlite3* handle_ = nullptr;
  std::map<const char*, sqlite3_stmt*> statements_;  // by address of the literal
};

// Bytes to bind as a BLOB; a plain string is bound as TEXT. Refers to a string that outlives the binding call.
struct Blob {
  const std::string& bytes;
};

// One run of a prepared statement: Query(connection, "... ? ... ?", text, number).Step(). Resets the statement when it
// ends. The text must be a literal.
class Query {
 public:
  template <typename... Values>
  Query(SqliteConnection& connection, const char* sql, const Values&... values)
      : connection_(connection), sql_(sql), statement_(connection.Prepared(sql)) {
    int index = 0;
    (Bind(++index, values), ...);
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  ~Query();

  // True if there is a row; false at the end. Throws.
  bool Step();
  // Runs to the end and returns the number of rows changed. Throws.
  int Run();

  // Columns of the row, from 0. NULL reads as 0 or "".
  int64_t Int(int column) const { return sqlite3_column_int64(statement_, column); }
  std::string Bytes(int column) const;

 private:
  void Bind(int index, int64_t value) { sqlite3_bind_int64(statement_, index, value); }
  void Bind(int index, int value) { sqlite3_bind_int64(statement_, index, value); }
  void Bind(int index, bool value) { sqlite3_bind_int64(statement_, index, value ? 1 : 0); }
  void Bind(int index, const std::string& text);
  void Bind(int index, const Blob& blob);
  void Bind(int index, std::nullptr_t) { sqlite3_bind_null(statement_, index); }

  SqliteConnection& connection_;
  const char* sql_;
  sqlite3_stmt* statement_;
};

// One transaction, rolled back if Commit was not reached.
class Transaction {
 public:
  enum class Kind {
    kRead,   // one snapshot for several queries
    kWrite,  // takes the writer's lock at once
  };
  Transaction(SqliteConnection& connection, Kind kind);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  // Durable when it returns. Throws.
  void Commit();

 private:
  SqliteConnection& connection_;
  bool open_ = true;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_CONNECTION_H_
