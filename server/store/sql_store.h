#ifndef ROLLGAIT_SERVER_STORE_SQL_STORE_H_
#define ROLLGAIT_SERVER_STORE_SQL_STORE_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/base/clock.h"
#include "server/store/database.h"
#include "server/store/disk_reserve.h"
#include "server/store/disk_room.h"
#include "server/store/model_store.h"
#include "server/store/solve_store.h"
#include "server/store/storage_use.h"

namespace rollgait::server {

// Solves and models in an SQL database. Threads may share it; so may processes (each with its own object): on one
// machine for SQLite, on any for PostgreSQL. Leases expire by {now_ns} of sql_dialect.h.
class SqlStore : public SolveStore, public ModelStore {
 public:
  // Makes the tables or brings them up to date; kUnavailable with the reason if that fails. New solves are refused when
  // there is no room; the reserve (null: none) is given up for what makes some. The clock outlives the store.
  static Outcome<std::unique_ptr<SqlStore>> Open(std::unique_ptr<Database> database, const Clock& clock,
                                                 DiskRoom room = {}, std::unique_ptr<DiskReserve> reserve = nullptr);

  Outcome<CreatedSolve> Create(const NewSolve& solve) override;
  Outcome<std::vector<CreatedSolve>> CreateAll(const std::vector<NewSolve>& solves) override;
  Outcome<bool> NeedsPlace(const NewSolve& solve) override;
  Outcome<SolveRecord> Get(const std::string& id) override;
  Outcome<SolveExtent> Extent(const std::string& id) override;
  Outcome<SolvePage> List(const ListQuery& query) override;
  Outcome<Done> Delete(const std::string& id, const Actor& actor = {}) override;
  Outcome<SolveRecord> RequestCancel(const std::string& id, const Actor& actor = {}) override;
  Outcome<SolveRecord> SetPriority(const std::string& id, int priority, const Actor& actor = {}) override;
  Outcome<EventPage> ReadEvents(const std::string& id, int64_t after_sequence, int max_events) override;
  Outcome<std::map<std::string, int64_t>> LastSequences(const std::vector<std::string>& ids) override;
  Outcome<std::string> Nearest(const NearQuery& query) override;
  Outcome<std::vector<UnplacedSolve>> Unplaced(int64_t after_number, int most) override;
  Outcome<Done> SetPlaces(const std::vector<PlacedSolve>& solves) override;
  Outcome<SolveCounts> Counts(const std::optional<std::string>& tenant = std::nullopt) override;
  Outcome<std::vector<AuditRow>> ReadAudit(int64_t after_number, int max_rows) override;
  Outcome<Removed> Retain(const RetentionLimits& limits) override;

  Outcome<std::optional<ClaimedSolve>> ClaimNext(const std::string& owner, std::chrono::milliseconds duration) override;
  Outcome<LeaseState> RenewLease(const Lease& lease, std::chrono::milliseconds duration) override;
  Outcome<LeaseState> AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) override;
  Outcome<std::vector<Outcome<LeaseState>>> AppendAll(const std::vector<EventBatch>& batches) override;
  Outcome<Done> Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) override;
  Outcome<Done> PutJournal(const Lease& lease, const std::string& journal) override;
  Outcome<std::optional<StoredJournal>> ReadJournal(const std::string& id) override;
  Outcome<SolveState> GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) override;
  Outcome<std::vector<std::string>> CancelRequests(const std::string& owner) override;
  Outcome<std::vector<LeaseOwner>> LeaseOwners() override;
  Outcome<std::vector<std::string>> ReclaimExpired() override;
  Outcome<std::vector<std::string>> ReclaimOwner(const std::string& owner) override;

  Outcome<CreatedModel> CreateModel(const NewModel& model) override;
  Outcome<ModelRecord> GetModel(const ModelKey& key) override;
  Outcome<ModelPage> ListModels(const ModelQuery& query) override;
  Outcome<Done> DeleteModel(const std::string& id, const Actor& actor) override;

  // For tables beside those of the solves.
  Database& database() { return *database_; }

 private:
  SqlStore(std::unique_ptr<Database> database, const Clock& clock, DiskRoom room, std::unique_ptr<DiskReserve> reserve,
           std::string page_secret)
      : database_(std::move(database)),
        clock_(clock),
        room_(std::move(room)),
        reserve_(std::move(reserve)),
        page_secret_(std::move(page_secret)) {}

  // A write that makes room in the end: on a full disk it is tried again with the reserve given up.
  template <typename Body>
  auto WriteForRoom(Body body) {
    auto outcome = database_->Write(body);
    const bool full = !outcome.ok() && outcome.error().code == ErrorCode::kResourceExhausted;
    if (!full || reserve_ == nullptr || !reserve_->Release()) return outcome;
    return database_->Write(body);
  }

  // nullopt: so near a limit of the queue that it takes LockMode::kExclusive to be sure.
  Outcome<std::optional<CreatedSolve>> TryCreate(const NewSolve& solve, SqlConnection::LockMode mode);
  // The same within a transaction that holds the locks, `writers` at the same time.
  Outcome<std::optional<CreatedSolve>> CreateIn(SqlConnection& connection, const NewSolve& solve, int writers,
                                                bool with_result);

  const std::unique_ptr<Database> database_;
  const Clock& clock_;
  const DiskRoom room_;
  const std::unique_ptr<DiskReserve> reserve_;
  const std::string page_secret_;  // of page tokens
  StorageUse storage_use_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQL_STORE_H_
