#include "server/store/sqlite_connection.h"

#include <thread>

#include "server/store/sql_dialect.h"

namespace rollgait::server {
namespace {

constexpr std::chrono::seconds kLongestWait(5);  // for a lock

SqlFailure::Kind KindOf(int code) {
  switch (code & 0xff) {
    case SQLITE_CONSTRAINT:
      return SqlFailure::Kind::kConflict;
    case SQLITE_FULL:
      return SqlFailure::Kind::kFull;
    case SQLITE_IOERR:  // a file that may not grow answers so
      return (code == SQLITE_IOERR_WRITE || code == SQLITE_IOERR_SHMSIZE || code == SQLITE_IOERR_TRUNCATE)
                 ? SqlFailure::Kind::kFull
                 : SqlFailure::Kind::kUnavailable;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_NOMEM:
      return SqlFailure::Kind::kUnavailable;
    default:
      return SqlFailure::Kind::kInternal;
  }
}

void PutBootId(sqlite3_context* context, int, sqlite3_value**) {
  const std::string id = static_cast<const Clock*>(sqlite3_user_data(context))->BootId();
  sqlite3_result_text(context, id.data(), static_cast<int>(id.size()), SQLITE_TRANSIENT);
}

void PutBootNanos(sqlite3_context* context, int, sqlite3_value**) {
  sqlite3_result_int64(context, static_cast<const Clock*>(sqlite3_user_data(context))->BootNanos());
}

}  // namespace

class SqliteStatement : public SqlStatement {
 public:
  SqliteStatement(SqliteConnection& connection, sqlite3* handle, const char* sql)
      : connection_(connection), handle_(handle), sql_(sql) {
    const std::string text = Translate(sql, kSqliteDialect);
    const int size = static_cast<int>(text.size());
    if (sqlite3_prepare_v3(handle, text.data(), size, SQLITE_PREPARE_PERSISTENT, &statement_, nullptr) != SQLITE_OK) {
      connection.Throw(sql);
    }
  }
  ~SqliteStatement() override { sqlite3_finalize(statement_); }

  void Bind(int index, int64_t value) override { Check(sqlite3_bind_int64(statement_, index, value)); }
  void Bind(int index, double value) override { Check(sqlite3_bind_double(statement_, index, value)); }
  void Bind(int index, const std::string& text) override {
    Check(sqlite3_bind_text64(statement_, index, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  }
  void Bind(int index, const Blob& blob) override {
    Check(sqlite3_bind_blob64(statement_, index, blob.bytes.data(), blob.bytes.size(), SQLITE_TRANSIENT));
  }
  void Ask() override {}  // the file is here: a question waits until its answer is wanted
  void Defer() override {
    while (Step()) {
    }
    Reset();
  }
  bool Step() override {
    const int code = sqlite3_step(statement_);
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) connection_.Throw(sql_);
    changes_ = sqlite3_changes(handle_);
    return false;
  }
  int64_t Int(int column) const override { return sqlite3_column_int64(statement_, column); }
  double Double(int column) const override { return sqlite3_column_double(statement_, column); }
  std::string Bytes(int column) const override {
    const void* data = sqlite3_column_blob(statement_, column);
    const int size = sqlite3_column_bytes(statement_, column);
    return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), static_cast<size_t>(size));
  }
  int changes() const override { return changes_; }
  void Reset() noexcept override {
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
    in_use_ = false;
  }
  bool in_use() const { return in_use_; }
  void MarkInUse() { in_use_ = true; }

 private:
  void Check(int code) const {
    if (code != SQLITE_OK) connection_.Throw(sql_);
  }

  SqliteConnection& connection_;
  sqlite3* const handle_;
  const char* const sql_;
  sqlite3_stmt* statement_ = nullptr;
  int changes_ = 0;
  bool in_use_ = false;
};

SqliteConnection::SqliteConnection(const std::string& path, const Clock& clock) : clock_(clock), turn_(path + "-turn") {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
  const int code = sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr);
  if (code != SQLITE_OK) {
    const std::string reason = handle_ != nullptr ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
    sqlite3_close(handle_);
    throw SqlFailure(KindOf(code), "cannot open " + path + ": " + reason);
  }
  try {
    sqlite3_busy_handler(handle_, LookAgain, this);
    Execute("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON;");
    AddClockFunctions();
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

SqliteConnection::~SqliteConnection() {
  statements_.Clear();
  sqlite3_close(handle_);
}

void SqliteConnection::AddClockFunctions() {
  void* clock = const_cast<Clock*>(&clock_);
  if (sqlite3_create_function_v2(handle_, "boot_id", 0, SQLITE_UTF8, clock, PutBootId, nullptr, nullptr, nullptr) !=
          SQLITE_OK ||
      sqlite3_create_function_v2(handle_, "boot_ns", 0, SQLITE_UTF8, clock, PutBootNanos, nullptr, nullptr, nullptr) !=
          SQLITE_OK) {
    Throw("boot_id, boot_ns");
  }
}

SqlStatement& SqliteConnection::Prepared(const char* sql) {
  return statements_.Take(sql, [&] { return std::make_unique<SqliteStatement>(*this, handle_, sql); });
}

void SqliteConnection::Execute(const std::string& sql) {
  if (sqlite3_exec(handle_, Translate(sql, kSqliteDialect).c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Throw(sql);
}

int SqliteConnection::LookAgain(void* connection, int looks) {
  auto* const self = static_cast<SqliteConnection*>(connection);
  const auto now = std::chrono::steady_clock::now();
  if (looks == 0) self->give_up_ = now + kLongestWait;
  if (now >= self->give_up_) return 0;
  std::this_thread::sleep_for(WriteTurn::kLook);
  return 1;
}

void SqliteConnection::Begin(Access access) {
  if (access != Access::kWrite) {
    Query(*this, "BEGIN").Run();
    return;
  }
  if (!turn_.Take(std::chrono::steady_clock::now() + kLongestWait)) {
    throw SqlFailure(SqlFailure::Kind::kUnavailable, "another process has been waiting to write for too long");
  }
  try {
    Query(*this, "BEGIN IMMEDIATE").Run();
  } catch (...) {
    turn_.Leave();
    throw;
  }
  turn_.Leave();
}

void SqliteConnection::Commit() { Query(*this, "COMMIT").Run(); }

void SqliteConnection::Rollback() noexcept {
  // SQLite may have rolled back by itself (disk full, I/O error): then nothing is left to undo.
  if (sqlite3_get_autocommit(handle_) == 0) sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
}

// A table that is replaced would take along the rows that refer to it, and take their references with it when it is
// renamed.
void SqliteConnection::BeginSchemaChange() {
  Execute("PRAGMA foreign_keys=OFF; PRAGMA legacy_alter_table=ON;");
  Begin(Access::kWrite);
}

void SqliteConnection::EndSchemaChange() noexcept {
  sqlite3_exec(handle_, "PRAGMA legacy_alter_table=OFF; PRAGMA foreign_keys=ON;", nullptr, nullptr, nullptr);
}

bool SqliteConnection::HasSchema() {
  return Query(*this, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'schema_version'").Step();
}

void SqliteConnection::Throw(const std::string& sql) const {
  throw SqlFailure(KindOf(sqlite3_extended_errcode(handle_)), std::string(sqlite3_errmsg(handle_)) + " in: " + sql);
}

}  // namespace rollgait::server
