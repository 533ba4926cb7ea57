#ifndef ROLLGAIT_SERVER_STORE_DATABASE_H_
#define ROLLGAIT_SERVER_STORE_DATABASE_H_

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/base/outcome.h"
#include "server/store/sql_connection.h"

namespace rollgait::server {

// Connections to one database, made when needed and used again. Any thread may call; a call waits when all are in use.
class Database {
 public:
  struct Options {
    std::string name;  // for messages; without a password
    std::function<std::unique_ptr<SqlConnection>()> connect;
    int writers = 1, readers = 2;  // most connections of each kind
    bool group_writes = false;     // writes that wait for one another share a transaction and its commit
  };
  explicit Database(Options options) : options_(std::move(options)) {}
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  // Runs `body(SqlConnection&)`, which returns an Outcome, in a transaction; commits if the outcome is good. The body
  // may run more than once: again after a conflict with another transaction and, if the connection was lost before the
  // commit was asked for, over a new one. kUnavailable also when it is not known whether the commit has happened, and
  // when no connection was free in time.
  template <typename Body>
  auto Write(Body body) {
    return Run(SqlConnection::Access::kWrite, body);
  }
  // The same for a body that changes nothing: one snapshot, retried after any loss of the connection.
  template <typename Body>
  auto Read(Body body) {
    return Run(SqlConnection::Access::kRead, body);
  }
  // The same for a body of one query.
  template <typename Body>
  auto ReadOne(Body body) {
    return Run(SqlConnection::Access::kOne, body);
  }
  // EnsureSchema (schema.h) over one of the connections.
  Outcome<Done> PrepareSchema();
  const std::string& name() const { return options_.name; }

 private:
  using Body = std::function<bool(SqlConnection&)>;  // returns whether to commit
  struct Waiting {
    const Body& body;
    std::optional<SqlFailure> failure = std::nullopt;
    bool done = false;
  };
  struct Pool {
    std::vector<std::unique_ptr<SqlConnection>> idle;
    int open = 0;  // idle or in use
    // Not in use any more, but the database works on an answer for them: kept, so that they are counted, until a call
    // of either kind finds it there.
    std::vector<std::unique_ptr<SqlConnection>> overdue = {};
  };

  template <typename Body>
  auto Run(SqlConnection::Access access, Body& body) -> decltype(body(std::declval<SqlConnection&>())) {
    using Answer = decltype(body(std::declval<SqlConnection&>()));
    std::optional<Answer> answer;
    const std::optional<Error> failure = Transact(access, [&](SqlConnection& connection) {
      answer.emplace(body(connection));
      return answer->ok();
    });
    return failure.has_value() ? Answer(*failure) : std::move(*answer);
  }

  std::optional<Error> Transact(SqlConnection::Access access, const Body& body);
  // One attempt; sets failure.
  void Alone(SqlConnection::Access access, Waiting& write);
  void InGroup(Waiting& write);
  void RunGroup(const std::vector<Waiting*>& group);
  bool TryTogether(const std::vector<Waiting*>& group);
  // Throws.
  std::unique_ptr<SqlConnection> Take(SqlConnection::Access access);
  void Return(SqlConnection::Access access, std::unique_ptr<SqlConnection> connection);
  void DropIdle();

  const Options options_;
  std::mutex mutex_;  // protects the pools
  std::condition_variable returned_;
  Pool writers_, readers_;
  std::mutex group_mutex_;  // protects what follows
  std::condition_variable group_done_;
  std::vector<Waiting*> waiting_;
  bool leading_ = false;  // a thread runs a group
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_DATABASE_H_
