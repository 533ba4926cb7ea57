#ifndef ROLLGAIT_SERVER_STORE_MEASURED_STORE_H_
#define ROLLGAIT_SERVER_STORE_MEASURED_STORE_H_

#include <optional>
#include <string>
#include <vector>

#include "server/store/solve_metrics.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// A store that counts and times what is asked of another: rollgait_store_seconds{op}, rollgait_store_errors_total{op}
// (what the store could not do: kUnavailable, kInternal), and what becomes of solves (SolveMetrics). Answers and errors
// are those of the other.
class MeasuredStore : public SolveStore {
 public:
  // Both outlive it.
  MeasuredStore(SolveStore& store, Metrics& metrics);

  Outcome<CreatedSolve> Create(const NewSolve& solve) override;
  Outcome<std::vector<CreatedSolve>> CreateAll(const std::vector<NewSolve>& solves) override;
  Outcome<bool> NeedsPlace(const NewSolve& solve) override;
  Outcome<SolveRecord> Get(const std::string& id) override;
  Outcome<SolveExtent> Extent(const std::string& id) override;
  Outcome<SolvePage> List(const ListQuery& query) override;
  Outcome<Done> Delete(const std::string& id, const Actor& actor) override;
  Outcome<SolveRecord> RequestCancel(const std::string& id, const Actor& actor) override;
  Outcome<SolveRecord> SetPriority(const std::string& id, int priority, const Actor& actor) override;
  Outcome<EventPage> ReadEvents(const std::string& id, int64_t after_sequence, int max_events) override;
  Outcome<std::map<std::string, int64_t>> LastSequences(const std::vector<std::string>& ids) override;
  Outcome<std::string> Nearest(const NearQuery& query) override;
  Outcome<std::vector<UnplacedSolve>> Unplaced(int64_t after_number, int most) override;
  Outcome<Done> SetPlaces(const std::vector<PlacedSolve>& solves) override;
  Outcome<SolveCounts> Counts(const std::optional<std::string>& tenant) override;
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

 private:
  // The outcome of `call`, timed and counted as `op`.
  template <typename Call>
  auto Measure(const char* op, Call call) -> decltype(call());
  // The same for a write under a lease.
  template <typename Call>
  auto MeasureLeased(const char* op, const Lease& lease, Call call) -> decltype(call());

  SolveStore& store_;
  prometheus::Family<prometheus::Histogram>& seconds_;
  prometheus::Family<prometheus::Counter>& errors_;
  SolveMetrics solves_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_MEASURED_STORE_H_
