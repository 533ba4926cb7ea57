#include "server/store/sqlite_connection.h"

namespace rollgait::server {

SqliteConnection::SqliteConnection(const std::string& path) {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  const int code = sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr);
  if (code != SQLITE_OK) {
    const std::string reason = handle_ != nullptr ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
    sqlite3_close(handle_);
    throw SqliteFailure(code & 0xff, "cannot open " + path + ": " + reason);
  }
  try {
    sqlite3_busy_timeout(handle_, 5000);
    Execute("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON;");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

SqliteConnection::~SqliteConnection() {
  for (const auto& [sql, statement] : statements_) sqlite3_finalize(statement);
  sqlite3_close(handle_);
}

void SqliteConnection::Execute(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) Throw(sql);
}

sqlite3_stmt* SqliteConnection::Prepared(const char* sql) {
  sqlite3_stmt*& statement = statements_[sql];
  if (statement == nullptr &&
      sqlite3_prepare_v3(handle_, sql, -1, SQLITE_PREPARE_PERSISTENT, &statement, nullptr) != SQLITE_OK) {
    Throw(sql);
  }
  return statement;
}

void SqliteConnection::Throw(const char* sql) const {
  throw SqliteFailure(sqlite3_errcode(handle_) & 0xff, std::string(sqlite3_errmsg(handle_)) + " in: " + sql);
}

Query::~Query() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

bool Query::Step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  connection_.Throw(sql_);
}

int Query::Run() {
  while (Step()) {
  }
  return connection_.changes();
}

std::string Query::Bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), static_cast<size_t>(size));
}

void Query::Bind(int index, const std::string& text) {
  if (sqlite3_bind_text64(statement_, index, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) != SQLITE_OK) {
    connection_.Throw(sql_);
  }
}

void Query::Bind(int index, const Blob& blob) {
  const std::string& bytes = blob.bytes;
  if (sqlite3_bind_blob64(statement_, index, bytes.data(), bytes.size(), SQLITE_TRANSIENT) != SQLITE_OK) {
    connection_.Throw(sql_);
  }
}

Transaction::Transaction(SqliteConnection& connection, Kind kind) : connection_(connection) {
  Query(connection_, kind == Kind::kWrite ? "BEGIN IMMEDIATE" : "BEGIN").Run();
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    Query(connection_, "ROLLBACK").Run();
  } catch (const SqliteFailure&) {
    // SQLite has already rolled back by itself (disk full, I/O error): nothing is left to undo.
  }
}

void Transaction::Commit() {
  Query(connection_, "COMMIT").Run();
  open_ = false;
}

}  // namespace rollgait::server
