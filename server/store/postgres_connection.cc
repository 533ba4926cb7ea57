#include "server/store/postgres_connection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "core/base/check.h"
#include "server/store/sql_dialect.h"

namespace rollgait::server {
namespace {

// Types of parameters, from the server's pg_type.
constexpr Oid kBytea = 17, kInt8 = 20, kText = 25, kFloat8 = 701;

// One schema change at a time in a database.
constexpr char kLockSchema[] = "SELECT pg_advisory_xact_lock(7310279081)";

// Settings of every session. Whoever stops in the middle of a transaction does not hold its locks for long.
constexpr char kSettings[] =
    "SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') IN ('off', 'local');"
    "SET lock_timeout = '10s'; SET idle_in_transaction_session_timeout = '15s';";

SqlFailure::Kind KindOf(const std::string& state) {
  for (const char* conflict : {"40001", "40P01", "23505", "23503"}) {
    if (state == conflict) return SqlFailure::Kind::kConflict;
  }
  if (state == "53100") return SqlFailure::Kind::kFull;
  // Gone, shut down, not a primary any more, or with plans of an older schema: a new connection is what helps.
  const std::string group = state.substr(0, 2);
  if (group == "08" || state == "25006" || state == "25P03" || state == "0A000") return SqlFailure::Kind::kLost;
  if (state.rfind("57P", 0) == 0) return SqlFailure::Kind::kLost;
  if (group == "53" || group == "57" || group == "58" || state == "55P03") return SqlFailure::Kind::kUnavailable;
  return SqlFailure::Kind::kInternal;
}

std::string FirstLine(const char* text) {
  const std::string all = text == nullptr ? "" : text;
  return all.substr(0, all.find('\n'));
}

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

class PostgresStatement : public SqlStatement {
 public:
  PostgresStatement(PostgresConnection& connection, PGconn* handle, const char* sql, std::string name)
      : connection_(connection), handle_(handle), sql_(sql), name_(std::move(name)) {}
  ~PostgresStatement() override { PQclear(result_); }

  void Bind(int index, int64_t value) override { Put(index, kInt8, BigEndian(static_cast<uint64_t>(value))); }
  void Bind(int index, double value) override { Put(index, kFloat8, BigEndian(std::bit_cast<uint64_t>(value))); }
  void Bind(int index, const std::string& text) override { Put(index, kText, text); }
  void Bind(int index, const Blob& blob) override { Put(index, kBytea, blob.bytes); }

  bool Step() override {
    if (result_ == nullptr) Execute();
    return ++row_ < PQntuples(result_);
  }
  int64_t Int(int column) const override {
    const int size = PQgetlength(result_, row_, column);
    const uint64_t value = FromBigEndian(PQgetvalue(result_, row_, column), size);
    return size == 4 ? static_cast<int32_t>(value) : static_cast<int64_t>(value);
  }
  double Double(int column) const override {
    return std::bit_cast<double>(FromBigEndian(PQgetvalue(result_, row_, column), PQgetlength(result_, row_, column)));
  }
  std::string Bytes(int column) const override {
    return std::string(PQgetvalue(result_, row_, column), static_cast<size_t>(PQgetlength(result_, row_, column)));
  }
  int changes() const override { return std::atoi(PQcmdTuples(result_)); }
  void Reset() noexcept override {
    PQclear(result_);
    result_ = nullptr;
    row_ = -1;
    values_.clear();
  }

 private:
  void Put(int index, Oid type, std::string bytes) {
    ROLLGAIT_CHECK(index == static_cast<int>(values_.size()) + 1);
    values_.push_back(std::move(bytes));
    if (!prepared_) types_.push_back(type);
  }

  void Execute() {
    const int count = static_cast<int>(values_.size());
    if (!prepared_) {
      const std::string text = Numbered(Translate(sql_, kPostgresDialect));
      PGresult* made = PQprepare(handle_, name_.c_str(), text.c_str(), count, types_.data());
      connection_.Check(made, sql_);
      PQclear(made);
      prepared_ = true;
    }
    std::vector<const char*> values;
    std::vector<int> lengths, formats(values_.size(), 1);
    for (const std::string& value : values_) {
      values.push_back(value.data());
      lengths.push_back(static_cast<int>(value.size()));
    }
    PGresult* result =
        PQexecPrepared(handle_, name_.c_str(), count, values.data(), lengths.data(), formats.data(), 1);
    connection_.Check(result, sql_);
    result_ = result;
    row_ = -1;
  }

  PostgresConnection& connection_;
  PGconn* const handle_;
  const char* const sql_;
  const std::string name_;
  bool prepared_ = false;
  std::vector<Oid> types_;
  std::vector<std::string> values_;
  PGresult* result_ = nullptr;
  int row_ = -1;
};

}  // namespace

PGconn* ConnectPostgres(const std::string& url, const char* application_name) {
  // What stands before dbname is overridden by the URL.
  constexpr std::array kNames = {"connect_timeout",     "target_session_attrs", "keepalives_idle", "keepalives_interval",
                                 "keepalives_count",    "tcp_user_timeout",     "client_encoding", "fallback_application_name",
                                 "dbname",              static_cast<const char*>(nullptr)};
  const std::array values = {"3",     "read-write",     "5",         "2", "3", "10000", "UTF8", application_name,
                             url.c_str(), static_cast<const char*>(nullptr)};
  PGconn* handle = PQconnectdbParams(kNames.data(), values.data(), 1);
  ROLLGAIT_CHECK(handle != nullptr);
  PQsetNoticeProcessor(handle, [](void*, const char*) {}, nullptr);
  return handle;
}

PostgresConnection::PostgresConnection(const std::string& url) : handle_(ConnectPostgres(url, "rollgait")) {
  if (PQstatus(handle_) != CONNECTION_OK) {
    const SqlFailure failure(SqlFailure::Kind::kUnavailable, FirstLine(PQerrorMessage(handle_)));
    PQfinish(handle_);
    throw failure;
  }
  try {
    Run(kSettings);
  } catch (...) {
    PQfinish(handle_);
    throw;
  }
}

PostgresConnection::~PostgresConnection() {
  statements_.clear();
  PQfinish(handle_);
}

void PostgresConnection::Check(PGresult* result, const char* sql) {
  const ExecStatusType status = PQresultStatus(result);
  if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK) return;
  const char* state = result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
  std::string message = FirstLine(result == nullptr ? PQerrorMessage(handle_) : PQresultErrorMessage(result));
  SqlFailure::Kind kind = state == nullptr ? SqlFailure::Kind::kLost : KindOf(state);
  if (PQstatus(handle_) == CONNECTION_BAD) kind = SqlFailure::Kind::kLost;
  if (kind == SqlFailure::Kind::kLost) lost_ = true;
  if (kind == SqlFailure::Kind::kInternal) message += std::string(" in: ") + sql;
  PQclear(result);
  throw SqlFailure(kind, message);
}

SqlStatement& PostgresConnection::Prepared(const char* sql) {
  std::unique_ptr<SqlStatement>& statement = statements_[sql];
  if (statement == nullptr) {
    statement = std::make_unique<PostgresStatement>(*this, handle_, sql, "s" + std::to_string(statements_.size()));
  }
  return *statement;
}

void PostgresConnection::Run(const char* sql) {
  PGresult* result = PQexec(handle_, sql);
  Check(result, sql);
  PQclear(result);
}

void PostgresConnection::Execute(const std::string& sql) { Run(Translate(sql, kPostgresDialect).c_str()); }

void PostgresConnection::Begin(Access access) {
  Run(access == Access::kWrite ? "BEGIN ISOLATION LEVEL READ COMMITTED READ WRITE"
                               : "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY");
}

void PostgresConnection::Commit() {
  PGresult* result = PQexec(handle_, "COMMIT");
  Check(result, "COMMIT");
  const bool committed = std::strcmp(PQcmdStatus(result), "COMMIT") == 0;  // else it was rolled back, without an error
  PQclear(result);
  if (!committed) throw SqlFailure(SqlFailure::Kind::kConflict, "the transaction was rolled back");
}

void PostgresConnection::Rollback() noexcept {
  if (PQtransactionStatus(handle_) != PQTRANS_IDLE) PQclear(PQexec(handle_, "ROLLBACK"));
}

LeaseTime PostgresConnection::Now() {
  Query query(*this, "SELECT CAST(EXTRACT(EPOCH FROM clock_timestamp()) * 1000000000 AS BIGINT)");
  ROLLGAIT_CHECK(query.Step());
  return {"database", query.Int(0)};
}

void PostgresConnection::BeginSchemaChange() {
  Begin(Access::kWrite);
  Run(kLockSchema);
}

bool PostgresConnection::HasSchema() {
  return Query(*this, "SELECT 1 WHERE to_regclass('schema_version') IS NOT NULL").Step();
}

}  // namespace rollgait::server
