#include "tests/schedules/recorded_store.h"

#include <utility>

#include "tests/schedules/event_words.h"

namespace rollgait::server {
namespace {

using CallKind = StoreCall::Kind;

std::string TagOf(const NewSolve& solve) {
  const auto place = solve.labels.find("tag");
  return place == solve.labels.end() ? "" : place->second;
}

SeenLease Seen(const Lease& lease) { return {lease.solve_id, lease.owner, lease.epoch}; }

std::vector<SeenEvent> Seen(const std::vector<StoredEvent>& events) {
  std::vector<SeenEvent> seen;
  for (const StoredEvent& event : events) seen.push_back({event.sequence, WordsOf(event.payload)});
  return seen;
}

int64_t Micros(std::chrono::milliseconds time) { return std::chrono::microseconds(time).count(); }

}  // namespace

void Recorder::Committed() {
  static const StoreCall kNone;
  const auto place = calls.find(scheduler.current());
  const StoreCall& call = place == calls.end() || place->second == nullptr ? kNone : *place->second;
  model.Committed(call, scheduler.now(), view.Solves(),
                  [this](int64_t number, int64_t after) { return view.Events(number, after); });
  if (model.violation()) scheduler.Note("VIOLATION: " + *model.violation());
}

template <typename Call>
auto RecordedStore::Record(StoreCall& record, Call call) -> decltype(call()) {
  recorder_.model.Begin(record, recorder_.scheduler.now());
  const StoreCall*& current = recorder_.calls[recorder_.scheduler.current()];
  struct Restore {
    const StoreCall*& place;
    const StoreCall* const before;
    ~Restore() { place = before; }
  } restore{current, std::exchange(current, &record)};
  return call();
}

template <typename Call>
auto RecordedStore::RecordLeased(StoreCall record, const Lease& lease, Call call) -> decltype(call(lease)) {
  record.leases = {Seen(lease)};
  record.events.resize(1);
  auto outcome = Record(record, [&] { return call(AsUsed(lease)); });
  const bool lost = !outcome.ok() && outcome.error().code == ErrorCode::kLeaseLost;
  if (outcome.ok() || lost) recorder_.model.LeasedAnswered(record, 0, lost);
  return outcome;
}

Lease RecordedStore::AsUsed(const Lease& lease) const {
  if (!recorder_.ignore_epochs) return lease;
  const std::optional<SeenLease> current = recorder_.model.LeaseOf(lease.solve_id);
  return current ? Lease{current->id, current->owner, current->epoch} : lease;
}

Outcome<CreatedSolve> RecordedStore::Create(const NewSolve& solve) {
  StoreCall record{CallKind::kCreate, {TagOf(solve)}};
  return Record(record, [&] { return store_.Create(solve); });
}

Outcome<std::vector<CreatedSolve>> RecordedStore::CreateAll(const std::vector<NewSolve>& solves) {
  StoreCall record{CallKind::kCreate};
  for (const NewSolve& solve : solves) record.tags.push_back(TagOf(solve));
  return Record(record, [&] { return store_.CreateAll(solves); });
}

Outcome<Done> RecordedStore::Delete(const std::string& id, const Actor& actor) {
  StoreCall record{.kind = CallKind::kDelete, .id = id};
  return Record(record, [&] { return store_.Delete(id, actor); });
}

Outcome<SolveRecord> RecordedStore::RequestCancel(const std::string& id, const Actor& actor) {
  StoreCall record{.kind = CallKind::kCancel, .id = id};
  return Record(record, [&] { return store_.RequestCancel(id, actor); });
}

Outcome<SolveRecord> RecordedStore::SetPriority(const std::string& id, int priority, const Actor& actor) {
  StoreCall record{.kind = CallKind::kSetPriority, .id = id};
  return Record(record, [&] { return store_.SetPriority(id, priority, actor); });
}

Outcome<Removed> RecordedStore::Retain(const RetentionLimits& limits) {
  StoreCall record{CallKind::kRetain};
  return Record(record, [&] { return store_.Retain(limits); });
}

Outcome<std::optional<ClaimedSolve>> RecordedStore::ClaimNext(const std::string& owner,
                                                              std::chrono::milliseconds duration) {
  StoreCall record{.kind = CallKind::kClaim, .owner = owner, .lease_us = Micros(duration)};
  auto outcome = Record(record, [&] { return store_.ClaimNext(owner, duration); });
  if (outcome.ok() && outcome.value()) recorder_.model.ClaimAnswered(Seen(outcome.value()->lease));
  return outcome;
}

Outcome<LeaseState> RecordedStore::RenewLease(const Lease& lease, std::chrono::milliseconds duration) {
  return RecordLeased({.kind = CallKind::kRenew, .lease_us = Micros(duration)}, lease,
                      [&](const Lease& used) { return store_.RenewLease(used, duration); });
}

Outcome<LeaseState> RecordedStore::AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) {
  return RecordLeased({.kind = CallKind::kAppend, .events = {Seen(events)}}, lease,
                      [&](const Lease& used) { return store_.AppendEvents(used, events); });
}

Outcome<std::vector<Outcome<LeaseState>>> RecordedStore::AppendAll(const std::vector<EventBatch>& batches) {
  StoreCall record{CallKind::kAppend};
  std::vector<EventBatch> used;
  for (const EventBatch& batch : batches) {
    record.leases.push_back(Seen(batch.lease));
    record.events.push_back(Seen(batch.events));
    used.push_back({AsUsed(batch.lease), batch.events, batch.solution});
  }
  auto outcomes = Record(record, [&] { return store_.AppendAll(used); });
  if (!outcomes.ok()) return outcomes;
  for (size_t i = 0; i < batches.size(); ++i) {
    const Outcome<LeaseState>& outcome = outcomes.value()[i];
    const bool lost = !outcome.ok() && outcome.error().code == ErrorCode::kLeaseLost;
    if (outcome.ok() || lost) recorder_.model.LeasedAnswered(record, i, lost);
  }
  return outcomes;
}

Outcome<Done> RecordedStore::Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) {
  return RecordLeased({.kind = CallKind::kFinish, .events = {Seen(events)}, .result = end.result}, lease,
                      [&](const Lease& used) { return store_.Finish(used, events, end); });
}

Outcome<Done> RecordedStore::PutJournal(const Lease& lease, const std::string& journal) {
  return RecordLeased({.kind = CallKind::kPutJournal}, lease,
                      [&](const Lease& used) { return store_.PutJournal(used, journal); });
}

Outcome<SolveState> RecordedStore::GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) {
  return RecordLeased({.kind = CallKind::kGiveBack}, lease,
                      [&](const Lease& used) { return store_.GiveBack(used, reason, detail); });
}

Outcome<std::vector<std::string>> RecordedStore::ReclaimExpired() {
  StoreCall record{CallKind::kReclaimExpired};
  return Record(record, [&] { return store_.ReclaimExpired(); });
}

Outcome<std::vector<std::string>> RecordedStore::ReclaimOwner(const std::string& owner) {
  StoreCall record{.kind = CallKind::kReclaimOwner, .owner = owner};
  return Record(record, [&] { return store_.ReclaimOwner(owner); });
}

}  // namespace rollgait::server
