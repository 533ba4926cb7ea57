#ifndef ROLLGAIT_TESTS_SCHEDULES_RECORDED_STORE_H_
#define ROLLGAIT_TESTS_SCHEDULES_RECORDED_STORE_H_

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "server/store/solve_store.h"
#include "tests/schedules/history_model.h"
#include "tests/schedules/scheduler.h"

namespace rollgait::server {

// Who asks the store what at this moment, and the model that hears of it.
struct Recorder {
  Scheduler& scheduler;
  HistoryModel& model;
  StoreView& view;
  std::map<Scheduler::ActorId, const StoreCall*> calls = {};
  bool ignore_epochs = false;  // a planted bug: writes are taken from whoever names a solve that runs

  // The call of the current actor has committed something.
  void Committed();
};

// A store that tells the model what it is asked and what it answers. Answers are those of the other.
class RecordedStore : public SolveStore {
 public:
  // Both outlive it.
  RecordedStore(SolveStore& store, Recorder& recorder) : store_(store), recorder_(recorder) {}

  Outcome<CreatedSolve> Create(const NewSolve& solve) override;
  Outcome<std::vector<CreatedSolve>> CreateAll(const std::vector<NewSolve>& solves) override;
  Outcome<Done> Delete(const std::string& id, const Actor& actor) override;
  Outcome<SolveRecord> RequestCancel(const std::string& id, const Actor& actor) override;
  Outcome<SolveRecord> SetPriority(const std::string& id, int priority, const Actor& actor) override;
  Outcome<Removed> Retain(const RetentionLimits& limits) override;
  Outcome<std::optional<ClaimedSolve>> ClaimNext(const std::string& owner, std::chrono::milliseconds duration) override;
  Outcome<LeaseState> RenewLease(const Lease& lease, std::chrono::milliseconds duration) override;
  Outcome<LeaseState> AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) override;
  Outcome<std::vector<Outcome<LeaseState>>> AppendAll(const std::vector<EventBatch>& batches) override;
  Outcome<Done> Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) override;
  Outcome<Done> PutJournal(const Lease& lease, const std::string& journal) override;
  Outcome<SolveState> GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) override;
  Outcome<std::vector<std::string>> ReclaimExpired() override;
  Outcome<std::vector<std::string>> ReclaimOwner(const std::string& owner) override;

  // Reads.
  Outcome<bool> NeedsPlace(const NewSolve& solve) override { return store_.NeedsPlace(solve); }
  Outcome<SolveRecord> Get(const std::string& id) override { return store_.Get(id); }
  Outcome<SolveExtent> Extent(const std::string& id) override { return store_.Extent(id); }
  Outcome<SolvePage> List(const ListQuery& query) override { return store_.List(query); }
  Outcome<EventPage> ReadEvents(const std::string& id, int64_t after_sequence, int max_events) override {
    return store_.ReadEvents(id, after_sequence, max_events);
  }
  Outcome<std::map<std::string, int64_t>> LastSequences(const std::vector<std::string>& ids) override {
    return store_.LastSequences(ids);
  }
  Outcome<std::string> Nearest(const NearQuery& query) override { return store_.Nearest(query); }
  Outcome<std::vector<UnplacedSolve>> Unplaced(int64_t after, int most) override {
    return store_.Unplaced(after, most);
  }
  Outcome<Done> SetPlaces(const std::vector<PlacedSolve>& solves) override { return store_.SetPlaces(solves); }
  Outcome<SolveCounts> Counts(const std::optional<std::string>& tenant) override { return store_.Counts(tenant); }
  Outcome<std::vector<AuditRow>> ReadAudit(int64_t after, int most) override { return store_.ReadAudit(after, most); }
  Outcome<std::vector<std::string>> CancelRequests(const std::string& owner) override {
    return store_.CancelRequests(owner);
  }
  Outcome<std::vector<LeaseOwner>> LeaseOwners() override { return store_.LeaseOwners(); }
  Outcome<std::optional<StoredJournal>> ReadJournal(const std::string& id) override { return store_.ReadJournal(id); }

 private:
  // Makes the call with the model told of it.
  template <typename Call>
  auto Record(StoreCall& record, Call call) -> decltype(call());
  // The same under a lease, which the call is given.
  template <typename Call>
  auto RecordLeased(StoreCall record, const Lease& lease, Call call) -> decltype(call(lease));
  Lease AsUsed(const Lease& lease) const;

  SolveStore& store_;
  Recorder& recorder_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_RECORDED_STORE_H_
