#include "server/store/measured_store.h"

#include <chrono>

namespace rollgait::server {
namespace {

const prometheus::Histogram::BucketBoundaries kCallSeconds = {0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01,
                                                              0.025,  0.05,    0.1,    0.25,  0.5,    1,     5};
constexpr const char* kOperations[] = {"create",         "create_all",    "get",    "list",        "delete",
                                       "request_cancel", "read_events",   "counts", "read_audit",  "claim",
                                       "renew_lease",    "append_events", "finish", "give_back",   "cancel_requests",
                                       "lease_owners",   "reclaim",       "retain", "put_journal", "read_journal"};

}  // namespace

MeasuredStore::MeasuredStore(SolveStore& store, Metrics& metrics)
    : store_(store),
      seconds_(HistogramFamily(metrics, "rollgait_store_seconds", "Time of the store's operations, in s")),
      errors_(CounterFamily(metrics, "rollgait_store_errors_total", "Operations that the store could not carry out")),
      solves_(metrics) {
  for (const char* op : kOperations) {
    seconds_.Add({{"op", op}}, kCallSeconds);
    errors_.Add({{"op", op}});
  }
}

template <typename Call>
auto MeasuredStore::Measure(const char* op, Call call) -> decltype(call()) {
  const auto start = std::chrono::steady_clock::now();
  auto outcome = call();
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
  seconds_.Add({{"op", op}}, kCallSeconds).Observe(duration.count());
  const bool failed = !outcome.ok() &&
                      (outcome.error().code == ErrorCode::kUnavailable || outcome.error().code == ErrorCode::kInternal);
  if (failed) errors_.Add({{"op", op}}).Increment();
  return outcome;
}

template <typename Call>
auto MeasuredStore::MeasureLeased(const char* op, const Lease& lease, Call call) -> decltype(call()) {
  auto outcome = Measure(op, call);
  if (!outcome.ok() && outcome.error().code == ErrorCode::kLeaseLost) solves_.LeaseLost(lease);
  return outcome;
}

Outcome<CreatedSolve> MeasuredStore::Create(const NewSolve& solve) {
  auto outcome = Measure("create", [&] { return store_.Create(solve); });
  if (outcome.ok() && outcome.value().created) solves_.Created(outcome.value().record.from_cache);
  return outcome;
}

Outcome<std::vector<CreatedSolve>> MeasuredStore::CreateAll(const std::vector<NewSolve>& solves) {
  auto outcome = Measure("create_all", [&] { return store_.CreateAll(solves); });
  if (!outcome.ok()) return outcome;
  for (const CreatedSolve& made : outcome.value()) {
    if (made.created) solves_.Created(made.record.from_cache);
  }
  return outcome;
}

Outcome<bool> MeasuredStore::NeedsPlace(const NewSolve& solve) {
  return Measure("needs_place", [&] { return store_.NeedsPlace(solve); });
}

Outcome<SolveRecord> MeasuredStore::Get(const std::string& id) {
  return Measure("get", [&] { return store_.Get(id); });
}

Outcome<SolveExtent> MeasuredStore::Extent(const std::string& id) {
  return Measure("extent", [&] { return store_.Extent(id); });
}

Outcome<SolvePage> MeasuredStore::List(const ListQuery& query) {
  return Measure("list", [&] { return store_.List(query); });
}

Outcome<Done> MeasuredStore::Delete(const std::string& id, const Actor& actor) {
  return Measure("delete", [&] { return store_.Delete(id, actor); });
}

Outcome<SolveRecord> MeasuredStore::RequestCancel(const std::string& id, const Actor& actor) {
  return Measure("request_cancel", [&] { return store_.RequestCancel(id, actor); });
}

Outcome<SolveRecord> MeasuredStore::SetPriority(const std::string& id, int priority, const Actor& actor) {
  return Measure("set_priority", [&] { return store_.SetPriority(id, priority, actor); });
}

Outcome<EventPage> MeasuredStore::ReadEvents(const std::string& id, int64_t after_sequence, int max_events) {
  return Measure("read_events", [&] { return store_.ReadEvents(id, after_sequence, max_events); });
}

Outcome<std::map<std::string, int64_t>> MeasuredStore::LastSequences(const std::vector<std::string>& ids) {
  return Measure("last_sequences", [&] { return store_.LastSequences(ids); });
}

Outcome<std::string> MeasuredStore::Nearest(const NearQuery& query) {
  return Measure("nearest", [&] { return store_.Nearest(query); });
}

Outcome<std::vector<UnplacedSolve>> MeasuredStore::Unplaced(int64_t after_number, int most) {
  return Measure("unplaced", [&] { return store_.Unplaced(after_number, most); });
}

Outcome<Done> MeasuredStore::SetPlaces(const std::vector<PlacedSolve>& solves) {
  return Measure("set_places", [&] { return store_.SetPlaces(solves); });
}

Outcome<SolveCounts> MeasuredStore::Counts(const std::optional<std::string>& tenant) {
  return Measure("counts", [&] { return store_.Counts(tenant); });
}

Outcome<std::vector<AuditRow>> MeasuredStore::ReadAudit(int64_t after_number, int max_rows) {
  return Measure("read_audit", [&] { return store_.ReadAudit(after_number, max_rows); });
}

Outcome<Removed> MeasuredStore::Retain(const RetentionLimits& limits) {
  return Measure("retain", [&] { return store_.Retain(limits); });
}

Outcome<std::optional<ClaimedSolve>> MeasuredStore::ClaimNext(const std::string& owner,
                                                              std::chrono::milliseconds duration) {
  auto outcome = Measure("claim", [&] { return store_.ClaimNext(owner, duration); });
  if (outcome.ok() && outcome.value()) solves_.Claimed(*outcome.value());
  return outcome;
}

Outcome<LeaseState> MeasuredStore::RenewLease(const Lease& lease, std::chrono::milliseconds duration) {
  return MeasureLeased("renew_lease", lease, [&] { return store_.RenewLease(lease, duration); });
}

Outcome<LeaseState> MeasuredStore::AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) {
  return MeasureLeased("append_events", lease, [&] { return store_.AppendEvents(lease, events); });
}

Outcome<std::vector<Outcome<LeaseState>>> MeasuredStore::AppendAll(const std::vector<EventBatch>& batches) {
  auto outcomes = Measure("append_events", [&] { return store_.AppendAll(batches); });
  for (size_t i = 0; outcomes.ok() && i < batches.size(); ++i) {
    const Outcome<LeaseState>& outcome = outcomes.value()[i];
    if (!outcome.ok() && outcome.error().code == ErrorCode::kLeaseLost) solves_.LeaseLost(batches[i].lease);
  }
  return outcomes;
}

Outcome<Done> MeasuredStore::Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) {
  auto outcome = MeasureLeased("finish", lease, [&] { return store_.Finish(lease, events, end); });
  if (outcome.ok()) solves_.Finished(lease, end);
  return outcome;
}

Outcome<Done> MeasuredStore::PutJournal(const Lease& lease, const std::string& journal) {
  return MeasureLeased("put_journal", lease, [&] { return store_.PutJournal(lease, journal); });
}

Outcome<std::optional<StoredJournal>> MeasuredStore::ReadJournal(const std::string& id) {
  return Measure("read_journal", [&] { return store_.ReadJournal(id); });
}

Outcome<SolveState> MeasuredStore::GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) {
  auto outcome = MeasureLeased("give_back", lease, [&] { return store_.GiveBack(lease, reason, detail); });
  if (outcome.ok()) solves_.GivenBack(lease, reason, outcome.value());
  return outcome;
}

Outcome<std::vector<std::string>> MeasuredStore::CancelRequests(const std::string& owner) {
  return Measure("cancel_requests", [&] { return store_.CancelRequests(owner); });
}

Outcome<std::vector<LeaseOwner>> MeasuredStore::LeaseOwners() {
  return Measure("lease_owners", [&] { return store_.LeaseOwners(); });
}

Outcome<std::vector<std::string>> MeasuredStore::ReclaimExpired() {
  auto outcome = Measure("reclaim", [&] { return store_.ReclaimExpired(); });
  if (outcome.ok()) solves_.Requeued("lease_expired", outcome.value().size());
  return outcome;
}

Outcome<std::vector<std::string>> MeasuredStore::ReclaimOwner(const std::string& owner) {
  auto outcome = Measure("reclaim", [&] { return store_.ReclaimOwner(owner); });
  if (outcome.ok()) solves_.Requeued("agent_died", outcome.value().size());
  return outcome;
}

}  // namespace rollgait::server
