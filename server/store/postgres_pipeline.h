#ifndef ROLLGAIT_SERVER_STORE_POSTGRES_PIPELINE_H_
#define ROLLGAIT_SERVER_STORE_POSTGRES_PIPELINE_H_

#include <libpq-fe.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/store/sql_connection.h"

namespace rollgait::server {

struct PostgresResultDeleter {
  void operator()(PGresult* result) const { PQclear(result); }
};
using PostgresResult = std::unique_ptr<PGresult, PostgresResultDeleter>;

// A statement that a session keeps by name; its text goes along with the first run.
struct PostgresPrepared {
  const char* sql;  // for messages
  std::string name, text;
  bool sent = false;
};

// Values of parameters in binary, with their types (pg_type).
struct PostgresValues {
  std::vector<Oid> types;
  std::vector<std::string> bytes;
};

// One run of a statement.
struct PostgresRun {
  PostgresResult result = nullptr;  // once it is answered
};

// Statements on their way over one connection, and the answers to them: libpq's pipeline mode. Add only sends; Settle
// waits for all that is unanswered, once. No wait is without a limit, and all but Push throw SqlFailure. One thread at
// a time.
class PostgresPipeline {
 public:
  // The connection is open, without statements under way; it outlives this.
  explicit PostgresPipeline(PGconn* handle);
  PostgresPipeline(const PostgresPipeline&) = delete;
  PostgresPipeline& operator=(const PostgresPipeline&) = delete;

  std::shared_ptr<PostgresRun> Add(PostgresPrepared& statement, const PostgresValues& values);
  // All that was added is answered afterwards. Throws the first failure; what was added after the failing statement, up
  // to the next Push, has not been done. No answer within the limit: kUnavailable, and the connection is lost.
  void Settle(std::chrono::milliseconds limit);
  // Does not wait: the answers come with the next Settle, in which those to what was added so far do not count as
  // failures. What is added afterwards runs even if one of these fails.
  void Push() noexcept;
  // Statements without parameters, which need not be one. Returns the first column of the last row, if there is one.
  std::string RunText(const std::string& text, std::chrono::milliseconds limit);

  bool lost() const { return lost_ || PQstatus(handle_) == CONNECTION_BAD; }
  // An answer that was not waited for any longer is still due. Reads what has come.
  bool AnswerDue() noexcept;
  // How often an answer was waited for.
  int64_t round_trips() const { return round_trips_; }

 private:
  using Deadline = std::chrono::steady_clock::time_point;
  // What the server answers one by one.
  struct Due {
    const char* sql = nullptr;  // null: a synchronization point
    std::shared_ptr<PostgresRun> run = nullptr;
    PostgresPrepared* preparing = nullptr;
    bool counts = true;  // as a failure, if it is one
  };

  void Synchronize();
  // The answer to the oldest statement, with all that belongs to it.
  PostgresResult Next(const Due& due, Deadline deadline);
  // Sends what is left and waits until libpq can be asked for a result without blocking.
  void Wait(Deadline deadline);
  [[noreturn]] void ThrowLost();
  // nullopt: it is good.
  std::optional<SqlFailure> FailureOf(const PGresult* result, const char* sql);

  PGconn* const handle_;
  std::deque<Due> due_;
  bool synchronized_ = true;  // the last of due_ is a synchronization point, or there is none
  bool lost_ = false, overdue_ = false;
  int64_t round_trips_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_POSTGRES_PIPELINE_H_
