#include "server/store/postgres_pipeline.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

using Kind = SqlFailure::Kind;
using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

Kind KindOf(const std::string& state) {
  for (const char* conflict : {"40001", "40P01", "23505", "23503"}) {
    if (state == conflict) return Kind::kConflict;
  }
  if (state == "53100") return Kind::kFull;
  // Gone, shut down, not a primary any more, or with plans of an older schema: a new connection is what helps.
  const std::string group = state.substr(0, 2);
  if (group == "08" || state == "25006" || state == "25P03" || state == "0A000") return Kind::kLost;
  if (state.rfind("57P", 0) == 0) return Kind::kLost;
  if (group == "53" || group == "57" || group == "58" || state == "55P03") return Kind::kUnavailable;
  return Kind::kInternal;
}

std::string FirstLine(const char* text) {
  const std::string all = text == nullptr ? "" : text;
  return all.substr(0, all.find('\n'));
}

}  // namespace

PostgresPipeline::PostgresPipeline(PGconn* handle) : handle_(handle) {
  ROLLGAIT_CHECK(PQsetnonblocking(handle, 1) == 0 && PQenterPipelineMode(handle) == 1);
}

void PostgresPipeline::ThrowLost() {
  lost_ = true;
  due_.clear();
  const std::string reason = FirstLine(PQerrorMessage(handle_));
  throw SqlFailure(Kind::kLost, reason.empty() ? "the connection is lost" : reason);
}

std::shared_ptr<PostgresRun> PostgresPipeline::Add(PostgresPrepared& statement, const PostgresValues& values) {
  if (lost()) ThrowLost();
  const int count = static_cast<int>(values.bytes.size());
  synchronized_ = false;
  if (!statement.sent) {
    if (PQsendPrepare(handle_, statement.name.c_str(), statement.text.c_str(), count, values.types.data()) != 1)
      ThrowLost();
    statement.sent = true;
    due_.push_back({statement.sql, nullptr, &statement});
  }
  std::vector<const char*> bytes;
  std::vector<int> lengths, formats(values.bytes.size(), 1);
  for (const std::string& value : values.bytes) {
    bytes.push_back(value.data());
    lengths.push_back(static_cast<int>(value.size()));
  }
  if (PQsendQueryPrepared(handle_, statement.name.c_str(), count, bytes.data(), lengths.data(), formats.data(), 1) !=
      1) {
    ThrowLost();
  }
  due_.push_back({statement.sql, std::make_shared<PostgresRun>()});
  return due_.back().run;
}

void PostgresPipeline::Synchronize() {
  if (synchronized_) return;
  if (PQpipelineSync(handle_) != 1) ThrowLost();
  due_.push_back({});
  synchronized_ = true;
}

void PostgresPipeline::Wait(Deadline deadline) {
  while (true) {
    const int unsent = PQflush(handle_);
    // A connection that broke may have an answer in its buffer that says why.
    if (unsent < 0 || PQstatus(handle_) == CONNECTION_BAD || PQisBusy(handle_) == 0) return;
    const auto left = std::chrono::ceil<milliseconds>(deadline - SteadyClock::now()).count();
    pollfd entry = {PQsocket(handle_), static_cast<short>(unsent > 0 ? POLLIN | POLLOUT : POLLIN), 0};
    const int ready = left > 0 ? poll(&entry, 1, static_cast<int>(std::min<int64_t>(left, 60'000))) : 0;
    ROLLGAIT_CHECK(ready >= 0 || errno == EINTR);
    if (ready == 0 && SteadyClock::now() >= deadline) {
      lost_ = overdue_ = true;
      throw SqlFailure(Kind::kUnavailable, "the database has not answered in time");
    }
    if (ready > 0 && (entry.revents & ~POLLOUT) != 0 && PQconsumeInput(handle_) == 0) return;
  }
}

std::optional<SqlFailure> PostgresPipeline::FailureOf(const PGresult* result, const char* sql) {
  const ExecStatusType status = PQresultStatus(result);
  if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK) return std::nullopt;
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  std::string message = FirstLine(PQresultErrorMessage(result));
  const Kind kind = state == nullptr || PQstatus(handle_) == CONNECTION_BAD ? Kind::kLost : KindOf(state);
  if (kind == Kind::kLost) lost_ = true;
  if (kind == Kind::kInternal) message += std::string(" in: ") + sql;
  return SqlFailure(kind, message);
}

PostgresResult PostgresPipeline::Next(const Due& due, Deadline deadline) {
  Wait(deadline);
  PostgresResult result(PQgetResult(handle_));
  if (result == nullptr) ThrowLost();
  // Null ends what belongs to a statement.
  for (bool more = due.sql != nullptr; more;) {
    Wait(deadline);
    more = PostgresResult(PQgetResult(handle_)) != nullptr;
  }
  return result;
}

void PostgresPipeline::Settle(milliseconds limit) {
  if (lost()) ThrowLost();
  Synchronize();
  if (due_.empty()) return;
  ++round_trips_;
  const Deadline deadline = SteadyClock::now() + limit;
  std::optional<SqlFailure> first;
  for (; !due_.empty(); due_.pop_front()) {
    const Due& due = due_.front();
    PostgresResult result = Next(due, deadline);
    if (due.sql == nullptr) continue;
    // What follows one that failed.
    const bool aborted = PQresultStatus(result.get()) == PGRES_PIPELINE_ABORTED;
    const std::optional<SqlFailure> failure = aborted ? std::nullopt : FailureOf(result.get(), due.sql);
    if (due.preparing != nullptr && (aborted || failure.has_value())) due.preparing->sent = false;
    if (failure.has_value() && (due.counts || lost()) && !first.has_value()) first.emplace(*failure);
    if (first.has_value() && lost()) break;
    if (due.run != nullptr) due.run->result = std::move(result);
  }
  if (lost()) due_.clear();
  if (first.has_value()) throw *first;
}

void PostgresPipeline::Push() noexcept {
  try {
    Synchronize();
    for (Due& due : due_) due.counts = false;
    if (PQflush(handle_) < 0) lost_ = true;
  } catch (const SqlFailure&) {
    lost_ = true;
  }
}

std::string PostgresPipeline::RunText(const std::string& text, milliseconds limit) {
  Settle(limit);
  if (PQexitPipelineMode(handle_) != 1 || PQsendQuery(handle_, text.c_str()) != 1) ThrowLost();
  ++round_trips_;
  const Deadline deadline = SteadyClock::now() + limit;
  std::optional<SqlFailure> first;
  std::string value;
  while (true) {
    Wait(deadline);
    const PostgresResult result(PQgetResult(handle_));
    if (result == nullptr) break;
    if (PQntuples(result.get()) > 0) value = PQgetvalue(result.get(), 0, 0);
    const std::optional<SqlFailure> failure = FailureOf(result.get(), text.c_str());
    if (failure.has_value() && !first.has_value()) first.emplace(*failure);
  }
  if (first.has_value() && lost()) throw *first;
  if (PQenterPipelineMode(handle_) != 1) ThrowLost();
  if (first.has_value()) throw *first;
  return value;
}

bool PostgresPipeline::AnswerDue() noexcept {
  if (!overdue_) return false;
  // Read and dropped: what matters is that it came. Two nulls in a row are the end.
  for (int nulls = 0; nulls < 2;) {
    if (PQstatus(handle_) == CONNECTION_BAD || PQconsumeInput(handle_) == 0) break;
    if (PQisBusy(handle_) != 0) return true;
    nulls = PostgresResult(PQgetResult(handle_)) == nullptr ? nulls + 1 : 0;
  }
  overdue_ = false;
  return false;
}

}  // namespace rollgait::server
