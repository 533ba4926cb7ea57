#include "server/store/postgres_connection.h"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "core/base/check.h"
#include "server/store/sql_dialect.h"

namespace rollgait::server {
namespace {

// Types of parameters, from the server's pg_type.
constexpr Oid kBytea = 17, kInt8 = 20, kText = 25, kFloat8 = 701;

constexpr std::chrono::hours kNoLimit(24);

constexpr char kBeginWrite[] = "BEGIN ISOLATION LEVEL READ COMMITTED READ WRITE";
constexpr char kBeginRead[] = "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY";
constexpr char kCommit[] = "COMMIT";
constexpr char kRollback[] = "ROLLBACK";

// One schema change at a time in a database.
constexpr char kLockSchema[] = "SELECT pg_advisory_xact_lock(7310279081)";

// Other locks, one a name and schema.
#define ROLLGAIT_LOCK_KEY "(hashtextextended(current_schema() || ' ' || ?, 7310279081))"

// Settings of every session. Whoever stops in the middle of a transaction does not hold its locks for long, and no
// statement works on for somebody who has given up.
constexpr char kSettings[] =
    "SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') IN ('off', "
    "'local');"
    "SET lock_timeout = '10s'; SET statement_timeout = '25s'; SET idle_in_transaction_session_timeout = '15s';"
    "SELECT current_setting('max_connections')";

// `?` becomes $1, $2, ...; our SQL has no question marks in strings.
std::string Numbered(const std::string& sql) {
  std::string text;
  int count = 0;
  for (const char letter : sql) {
    if (letter == '?') {
      text += '$' + std::to_string(++count);
    } else {
      text += letter;
    }
  }
  return text;
}

std::string BigEndian(uint64_t value) {
  std::string bytes(8, '\0');
  for (int i = 7; i >= 0; --i, value >>= 8) bytes[static_cast<size_t>(i)] = static_cast<char>(value & 0xff);
  return bytes;
}

uint64_t FromBigEndian(const char* bytes, int size) {
  uint64_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// An open connection; throws.
PGconn* Connected(const std::string& url) {
  PGconn* handle = ConnectPostgres(url, "rollgait");
  if (PQstatus(handle) == CONNECTION_OK) return handle;
  const std::string message = PQerrorMessage(handle);
  PQfinish(handle);
  throw SqlFailure(SqlFailure::Kind::kUnavailable, message.substr(0, message.find('\n')));
}

}  // namespace

class PostgresStatement : public SqlStatement {
 public:
  PostgresStatement(PostgresConnection& connection, PostgresPrepared& prepared)
      : connection_(connection), prepared_(prepared) {}

  void Bind(int index, int64_t value) override { Put(index, kInt8, BigEndian(static_cast<uint64_t>(value))); }
  void Bind(int index, double value) override { Put(index, kFloat8, BigEndian(std::bit_cast<uint64_t>(value))); }
  void Bind(int index, const std::string& text) override { Put(index, kText, text); }
  void Bind(int index, const Blob& blob) override { Put(index, kBytea, blob.bytes); }

  void Ask() override { run_ = connection_.Send(prepared_, values_); }
  void Defer() override {
    connection_.Send(prepared_, values_);
    Reset();
  }
  bool Step() override {
    if (result() == nullptr) connection_.Settle();
    ROLLGAIT_CHECK(result() != nullptr);
    return ++row_ < PQntuples(result());
  }
  int64_t Int(int column) const override {
    const int size = PQgetlength(result(), row_, column);
    const uint64_t value = FromBigEndian(PQgetvalue(result(), row_, column), size);
    return size == 4 ? static_cast<int32_t>(value) : static_cast<int64_t>(value);
  }
  double Double(int column) const override {
    return std::bit_cast<double>(
        FromBigEndian(PQgetvalue(result(), row_, column), PQgetlength(result(), row_, column)));
  }
  std::string Bytes(int column) const override {
    return std::string(PQgetvalue(result(), row_, column), static_cast<size_t>(PQgetlength(result(), row_, column)));
  }
  int changes() const override { return std::atoi(PQcmdTuples(result())); }
  void Reset() noexcept override {
    run_.reset();
    row_ = -1;
    values_.types.clear();
    values_.bytes.clear();
    in_use_ = false;
  }
  bool in_use() const { return in_use_; }
  void MarkInUse() { in_use_ = true; }

 private:
  PGresult* result() const { return run_->result.get(); }

  void Put(int index, Oid type, std::string bytes) {
    ROLLGAIT_CHECK(index == static_cast<int>(values_.bytes.size()) + 1);
    values_.types.push_back(type);
    values_.bytes.push_back(std::move(bytes));
  }

  PostgresConnection& connection_;
  PostgresPrepared& prepared_;
  PostgresValues values_;
  std::shared_ptr<PostgresRun> run_;
  int row_ = -1;
  bool in_use_ = false;
};

PGconn* ConnectPostgres(const std::string& url, const char* application_name) {
  // What stands before dbname is overridden by the URL.
  constexpr std::array kNames = {"connect_timeout",  "target_session_attrs",
                                 "keepalives_idle",  "keepalives_interval",
                                 "keepalives_count", "tcp_user_timeout",
                                 "client_encoding",  "fallback_application_name",
                                 "dbname",           static_cast<const char*>(nullptr)};
  const std::array values = {"3",         "read-write",
                             "5",         "2",
                             "3",         "10000",
                             "UTF8",      application_name,
                             url.c_str(), static_cast<const char*>(nullptr)};
  PGconn* handle = PQconnectdbParams(kNames.data(), values.data(), 1);
  ROLLGAIT_CHECK(handle != nullptr);
  PQsetNoticeProcessor(
      handle, [](void*, const char*) {}, nullptr);
  return handle;
}

PostgresConnection::PostgresConnection(const std::string& url, const Limits& limits)
    : limits_(limits), handle_(Connected(url)), pipeline_(handle_.get()) {
  most_writers_ = std::stoi(pipeline_.RunText(kSettings, limits.answer));
}

PostgresConnection::~PostgresConnection() = default;

PostgresPrepared& PostgresConnection::PreparedText(const char* sql) {
  const auto [place, is_new] = prepared_.try_emplace(sql);
  if (is_new) place->second = {sql, "s" + std::to_string(prepared_.size()), Numbered(Translate(sql, kPostgresDialect))};
  return place->second;
}

SqlStatement& PostgresConnection::Prepared(const char* sql) {
  return statements_.Take(sql, [&] { return std::make_unique<PostgresStatement>(*this, PreparedText(sql)); });
}

void PostgresConnection::BeginIfAsked() {
  if (transaction_ != Transaction::kAsked) return;
  transaction_ = Transaction::kOpen;
  pipeline_.Add(PreparedText(access_ == Access::kWrite ? kBeginWrite : kBeginRead), {});
}

std::shared_ptr<PostgresRun> PostgresConnection::Send(PostgresPrepared& statement, const PostgresValues& values) {
  BeginIfAsked();
  return pipeline_.Add(statement, values);
}

void PostgresConnection::Execute(const std::string& sql) {
  BeginIfAsked();
  pipeline_.RunText(Translate(sql, kPostgresDialect), kNoLimit);
}

void PostgresConnection::Begin(Access access) {
  ROLLGAIT_CHECK(transaction_ == Transaction::kNone);
  access_ = access;
  transaction_ = Transaction::kAsked;
}

void PostgresConnection::Commit() {
  // One that only read has nothing to wait for.
  if (transaction_ != Transaction::kOpen || access_ != Access::kWrite) return Rollback();
  const std::shared_ptr<PostgresRun> run = pipeline_.Add(PreparedText(kCommit), {});
  try {
    pipeline_.Settle(limits_.commit);
  } catch (const SqlFailure& failure) {
    if (lost()) throw SqlFailure(SqlFailure::Kind::kUnknown, failure.what());
    throw;
  }
  transaction_ = Transaction::kNone;
  const bool committed =
      std::strcmp(PQcmdStatus(run->result.get()), kCommit) == 0;  // else it was rolled back, without an error
  if (!committed) throw SqlFailure(SqlFailure::Kind::kConflict, "the transaction was rolled back");
}

void PostgresConnection::Rollback() noexcept {
  const bool open = transaction_ == Transaction::kOpen && !lost();
  transaction_ = Transaction::kNone;
  if (!open) return;
  pipeline_.Push();
  try {
    pipeline_.Add(PreparedText(kRollback), {});
  } catch (const SqlFailure&) {
    return;  // lost, and the transaction with it
  }
  pipeline_.Push();
}

void PostgresConnection::Lock(const std::string& name, LockMode mode) {
  if (mode == LockMode::kShared) {
    Query::Do(*this, "SELECT pg_advisory_xact_lock_shared" ROLLGAIT_LOCK_KEY, name);
  } else {
    Query::Do(*this, "SELECT pg_advisory_xact_lock" ROLLGAIT_LOCK_KEY, name);
  }
}

void PostgresConnection::BeginSchemaChange() {
  Begin(Access::kWrite);
  Execute("SET LOCAL statement_timeout = 0");  // a migration takes as long as it takes
  Query(*this, kLockSchema).Run();
}

bool PostgresConnection::HasSchema() {
  return Query(*this, "SELECT 1 WHERE to_regclass('schema_version') IS NOT NULL").Step();
}

}  // namespace rollgait::server
