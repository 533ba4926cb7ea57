#ifndef ROLLGAIT_SERVER_STORE_SQLITE_STORE_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_STORE_H_

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/base/clock.h"
#include "server/store/solve_store.h"
#include "server/store/sqlite_connection.h"

namespace rollgait::server {

// Solves in one SQLite file. Reads and writes use one connection each, so that readers do not wait for a commit.
// Leases expire by the time since boot. Threads may share it; so may processes on one machine (each with its own
// object).
class SqliteStore : public SolveStore {
 public:
  // Opens or creates the file. kUnavailable with SQLite's reason if that fails. The clock outlives the store.
  static Outcome<std::unique_ptr<SqliteStore>> Open(const std::string& path, const Clock& clock);

  Outcome<CreatedSolve> Create(const NewSolve& solve) override;
  Outcome<SolveRecord> Get(const std::string& id) override;
  Outcome<SolvePage> List(const ListQuery& query) override;
  Outcome<Done> Delete(const std::string& id) override;
  Outcome<SolveRecord> RequestCancel(const std::string& id) override;
  Outcome<EventPage> ReadEvents(const std::string& id, int64_t after_sequence, int max_events) override;
  Outcome<SolveCounts> Counts() override;

  Outcome<std::optional<ClaimedSolve>> ClaimNext(const std::string& owner, std::chrono::milliseconds duration) override;
  Outcome<LeaseState> RenewLease(const Lease& lease, std::chrono::milliseconds duration) override;
  Outcome<LeaseState> AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) override;
  Outcome<Done> Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) override;
  Outcome<SolveState> GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) override;
  Outcome<std::vector<std::string>> CancelRequests(const std::string& owner) override;
  Outcome<std::vector<std::string>> LeaseOwners() override;
  Outcome<std::vector<std::string>> ReclaimExpired() override;
  Outcome<std::vector<std::string>> ReclaimOwner(const std::string& owner) override;

 private:
  SqliteStore(const std::string& path, const Clock& clock) : writer_(path), reader_(path), clock_(clock) {}

  // Runs `body(connection)`, which returns an Outcome, in a transaction; commits if the outcome is good.
  template <typename Body>
  auto Write(Body body) {
    return Run(writer_, writer_mutex_, Transaction::Kind::kWrite, body);
  }
  template <typename Body>
  auto Read(Body body) {
    return Run(reader_, reader_mutex_, Transaction::Kind::kRead, body);
  }
  template <typename Body>
  static auto Run(SqliteConnection& connection, std::mutex& mutex, Transaction::Kind kind, Body body)
      -> decltype(body(connection)) {
    const std::lock_guard<std::mutex> lock(mutex);
    try {
      Transaction transaction(connection, kind);
      auto outcome = body(connection);
      if (outcome.ok()) transaction.Commit();
      return outcome;
    } catch (const SqliteFailure& failure) {
      return ToError(failure);
    }
  }
  static Error ToError(const SqliteFailure& failure);
  int64_t LeaseEnd(std::chrono::milliseconds duration) const;

  std::mutex writer_mutex_, reader_mutex_;
  SqliteConnection writer_, reader_;
  const Clock& clock_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_STORE_H_
