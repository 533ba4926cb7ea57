#include "tests/schedules/history_model.h"

#include <algorithm>
#include <cstdio>

namespace rollgait::server {
namespace {

using CallKind = StoreCall::Kind;

// v1::SolveState.
constexpr int kQueued = 1, kRunning = 2, kSucceeded = 3, kFailed = 4, kCancelled = 5;

bool IsOver(int state) { return state >= kSucceeded; }

std::string Number(int64_t value) { return std::to_string(value); }

}  // namespace

void HistoryModel::Violated(const std::string& id, const std::string& what) {
  if (!violation_) violation_ = "solve " + id + ": " + what;
}

const SeenLease* HistoryModel::LeaseIn(const StoreCall& call, const std::string& id) {
  for (const SeenLease& lease : call.leases) {
    if (lease.id == id) return &lease;
  }
  return nullptr;
}

bool HistoryModel::Holds(const SeenLease& lease) const {
  const auto place = solves_.find(lease.id);
  if (place == solves_.end() || place->second.gone) return false;
  const SeenSolve& last = place->second.last;
  return last.state == kRunning && last.owner == lease.owner && last.epoch == lease.epoch;
}

std::optional<SeenLease> HistoryModel::LeaseOf(const std::string& id) const {
  const auto place = solves_.find(id);
  if (place == solves_.end() || place->second.gone || place->second.last.state != kRunning) return std::nullopt;
  return SeenLease{id, place->second.last.owner, place->second.last.epoch};
}

int HistoryModel::StateOf(const std::string& id) const {
  const auto place = solves_.find(id);
  return place == solves_.end() || place->second.gone ? 0 : place->second.last.state;
}

int64_t HistoryModel::TrimmedOf(const std::string& id) const {
  const auto place = solves_.find(id);
  return place == solves_.end() ? 0 : place->second.last.trimmed;
}

bool HistoryModel::AllEnded() const {
  return std::all_of(solves_.begin(), solves_.end(),
                     [](const auto& entry) { return entry.second.gone || IsOver(entry.second.last.state); });
}

void HistoryModel::Begin(StoreCall& call, int64_t now_us) const {
  call.began_us = now_us;
  for (const SeenLease& lease : call.leases) call.held.push_back(Holds(lease));
}

void HistoryModel::Committed(const StoreCall& call, int64_t now_us, const std::vector<SeenSolve>& solves,
                             const EventsOf& events) {
  ++counts_["commits"];
  if (call.kind == CallKind::kClaim) CheckTurn(solves);
  std::set<std::string> there;
  for (const SeenSolve& seen : solves) {
    there.insert(seen.id);
    const auto place = solves_.find(seen.id);
    if (place == solves_.end()) {
      Appear(call, seen, events);
    } else {
      Change(call, now_us, place->second, seen, events);
    }
  }
  for (auto& [id, solve] : solves_) {
    if (!solve.gone && there.count(id) == 0) Vanish(call, solve);
  }
  CheckTogether(call);
  if (call.kind != CallKind::kRenew) return;
  for (const SeenLease& lease : call.leases) {
    int64_t& end = solves_[lease.id].lease_least_end_us;
    if (Holds(lease)) end = std::max(end, call.began_us + call.lease_us);
  }
}

void HistoryModel::Appear(const StoreCall& call, const SeenSolve& seen, const EventsOf& events) {
  const bool wanted = std::find(call.tags.begin(), call.tags.end(), seen.tag) != call.tags.end();
  if (call.kind != CallKind::kCreate || !wanted) Violated(seen.id, "is there and was not asked for");
  for (const auto& [id, other] : solves_) {
    if (!other.gone && other.last.tag == seen.tag) {
      Violated(seen.id, "was made for " + seen.tag + ", which has " + id + " already");
    }
  }
  ++counts_["solves"];
  if (seen.state == kSucceeded) ++counts_["solves that a held result answers"];
  Solve& solve = solves_[seen.id];
  solve.last.state = kQueued;
  if (seen.state == kSucceeded) {
    if (results_[seen.key].count(seen.result) == 0) Violated(seen.id, "has a result that no equal solve had");
  } else if (seen.state != kQueued) {
    Violated(seen.id, "begins in state " + Number(seen.state));
  }
  CheckLog(solve, seen, events);
  solve.last = seen;
}

void HistoryModel::Change(const StoreCall& call, int64_t now_us, Solve& solve, const SeenSolve& seen,
                          const EventsOf& events) {
  const SeenSolve& last = solve.last;
  if (solve.gone) return Violated(seen.id, "is there again after it was deleted");
  const bool same_state = last.state == seen.state && last.epoch == seen.epoch && last.owner == seen.owner;
  const bool same_end = last.result == seen.result && last.error == seen.error;
  const bool same_log = last.last_sequence == seen.last_sequence;
  if (IsOver(last.state) && !(same_state && same_end && same_log)) Violated(seen.id, "changes after its end");
  if (seen.epoch < last.epoch) Violated(seen.id, "goes back to epoch " + Number(seen.epoch));
  if (seen.trimmed != last.trimmed && (call.kind != CallKind::kRetain || !IsOver(last.state))) {
    Violated(seen.id, "loses events, and it is not retention that removes them");
  }
  if (seen.cancel_requested && !last.cancel_requested && (call.kind != CallKind::kCancel || call.id != seen.id)) {
    Violated(seen.id, "is to be cancelled, and the call does not ask for it");
  }
  if (seen.priority != last.priority && (call.kind != CallKind::kSetPriority || last.state != kQueued)) {
    Violated(seen.id, "has another priority, and the call may not change it");
  }
  if (last.cancel_requested && !seen.cancel_requested) Violated(seen.id, "is not to be cancelled any more");
  if (!same_state) CheckTransition(call, now_us, solve, seen);
  if (same_state && !same_log) {
    const SeenLease* lease = LeaseIn(call, seen.id);
    if (call.kind != CallKind::kAppend && call.kind != CallKind::kGiveBack)
      Violated(seen.id, "gets events from this call");
    if (lease == nullptr || !Holds(*lease)) Violated(seen.id, "gets events under a lease that is lost");
  }
  if (!same_state && seen.state == kRunning) solve.lease_least_end_us = call.began_us + call.lease_us;
  CheckLog(solve, seen, events);
  solve.last = seen;
}

void HistoryModel::CheckTransition(const StoreCall& call, int64_t now_us, const Solve& solve, const SeenSolve& seen) {
  const SeenSolve& last = solve.last;
  const std::string step = "goes from state " + Number(last.state) + " to " + Number(seen.state);
  if (seen.state == kRunning) {
    ++counts_[seen.epoch == 1 ? "first claims" : "further claims"];
    claims_.insert({seen.id, seen.epoch});
    const bool good = call.kind == CallKind::kClaim && last.state == kQueued && seen.epoch == last.epoch + 1 &&
                      seen.owner == call.owner && !last.cancel_requested;
    if (!good) Violated(seen.id, step + " without a claim");
    for (const auto& [id, other] : solves_) {
      const bool equal = id != seen.id && !other.gone && !seen.key.empty() && other.last.key == seen.key;
      if (equal && other.last.state == kRunning) Violated(seen.id, "runs beside the equal " + id);
    }
    return;
  }
  if (last.state == kRunning) {
    const SeenLease* lease = LeaseIn(call, seen.id);
    const bool leased = call.kind == CallKind::kFinish || call.kind == CallKind::kGiveBack;
    if (leased && (lease == nullptr || !Holds(*lease))) Violated(seen.id, step + " under a lease that is lost");
    if (call.kind == CallKind::kReclaimOwner && (call.owner != last.owner || dead_owners_.count(last.owner) == 0)) {
      Violated(seen.id, "is taken from " + last.owner + ", which lives");
    }
    if (call.kind == CallKind::kReclaimExpired && now_us < solve.lease_least_end_us) {
      Violated(seen.id, "is taken from " + last.owner + ", whose lease has not expired");
    }
    if (call.kind == CallKind::kReclaimOwner) ++counts_["taken from a dead agent"];
    if (call.kind == CallKind::kReclaimExpired) ++counts_["taken after a lease expired"];
    if (call.kind == CallKind::kGiveBack) ++counts_["given back"];
    const bool reclaim = call.kind == CallKind::kReclaimOwner || call.kind == CallKind::kReclaimExpired;
    if (!leased && !reclaim) Violated(seen.id, step + " by a call that may not do that");
    if (seen.state == kQueued && last.cancel_requested) Violated(seen.id, "is queued again and was to be cancelled");
    if (seen.state == kQueued && call.kind == CallKind::kFinish) Violated(seen.id, step + " by its end");
  }
  if (IsOver(seen.state)) CheckEnd(call, last, seen);
}

void HistoryModel::CheckEnd(const StoreCall& call, const SeenSolve& earlier, const SeenSolve& seen) {
  const bool waited = earlier.state == kQueued;
  if (seen.state == kSucceeded) ++counts_[waited ? "solves that an equal one answers" : "results"];
  if (seen.state == kFailed) ++counts_["failures"];
  if (seen.state == kCancelled) ++counts_[waited ? "cancelled in the queue" : "cancelled while they ran"];
  if (earlier.state == kQueued && seen.state == kSucceeded) {
    const bool may = call.kind == CallKind::kClaim || call.kind == CallKind::kFinish;
    if (!may) Violated(seen.id, "has a result from this call");
    if (call.kind == CallKind::kFinish) results_[seen.key].insert(call.result);
    if (results_[seen.key].count(seen.result) == 0) Violated(seen.id, "has a result that no equal solve had");
  } else if (seen.state == kSucceeded) {
    if (call.kind != CallKind::kFinish || seen.result != call.result)
      Violated(seen.id, "has another result than was given");
    results_[seen.key].insert(seen.result);
  } else if (!seen.result.empty() || seen.error.empty()) {
    Violated(seen.id, "has not succeeded and has a result, or no error");
  }
  if (seen.state == kCancelled && cancel_asked_.count(seen.id) == 0) Violated(seen.id, "is cancelled, unasked");
  if (seen.state == kCancelled && earlier.state == kQueued && call.kind != CallKind::kCancel) {
    Violated(seen.id, "is cancelled in the queue by a call that may not do that");
  }
  if (seen.state == kFailed && earlier.state == kQueued) Violated(seen.id, "fails without having run");
}

void HistoryModel::CheckLog(Solve& solve, const SeenSolve& seen, const EventsOf& events) {
  const auto known = static_cast<int64_t>(solve.log.size());
  if (seen.last_sequence < known) return Violated(seen.id, "has lost its newest events");
  if (seen.held_events != seen.last_sequence - seen.trimmed) {
    return Violated(seen.id, "holds " + Number(seen.held_events) + " events, and the last is " +
                                 Number(seen.last_sequence) + " and the last removed " + Number(seen.trimmed));
  }
  if (seen.last_sequence == known) return;
  for (const SeenEvent& event : events(seen.number, known)) {
    const auto next = static_cast<int64_t>(solve.log.size()) + 1;
    if (event.sequence != next) return Violated(seen.id, "has no event " + Number(next));
    if (!solve.log.empty() && solve.log.back().what == "finished") {
      return Violated(seen.id, "has an event after the last one");
    }
    int mesh = 0, index = 0;
    if (std::sscanf(event.what.c_str(), "iteration %d %d", &mesh, &index) == 2) {
      if (index > solve.newest_iteration + 1) Violated(seen.id, "has lost the iteration before " + Number(index));
      solve.newest_iteration = std::max(solve.newest_iteration, index);
    }
    solve.log.push_back(event);
  }
  const bool finished = !solve.log.empty() && solve.log.back().what == "finished";
  if (finished != IsOver(seen.state)) Violated(seen.id, "has another state than its last event says");
}

void HistoryModel::Vanish(const StoreCall& call, Solve& solve) {
  const std::string& id = solve.last.id;
  const bool asked = call.kind == CallKind::kDelete && call.id == id && delete_asked_.count(id) != 0;
  if (!asked && call.kind != CallKind::kRetain) Violated(id, "is gone and nobody removed it");
  if (!IsOver(solve.last.state)) Violated(id, "is removed before it has ended");
  ++counts_[asked ? "deleted" : "removed by retention"];
  solve.gone = true;
}

// What was created together is there together.
void HistoryModel::CheckTogether(const StoreCall& call) {
  for (const std::string& tag : call.tags) {
    const bool there = std::any_of(solves_.begin(), solves_.end(), [this, &tag](const auto& entry) {
      // Where others write at the same time one of an earlier call may be removed before this one commits.
      return (!entry.second.gone || claimers_ > 1) && entry.second.last.tag == tag;
    });
    if (!there) Violated("for " + tag, "is not there after the commit that makes it");
  }
}

void HistoryModel::LeasedAnswered(const StoreCall& call, size_t lease, bool lost) {
  const SeenLease& seen = call.leases[lease];
  if (lost) ++counts_["writes refused, as the lease is lost"];
  if (lost) {
    if (Holds(seen)) Violated(seen.id, "has a lease of " + seen.owner + ", who is told that it is lost");
    return;
  }
  if (!call.held[lease]) {
    return Violated(seen.id,
                    "took a write of " + seen.owner + " under epoch " + Number(seen.epoch) + ", which is over");
  }
  const Solve& solve = solves_[seen.id];
  for (const SeenEvent& event : call.events[lease]) {
    const bool known = event.sequence >= 1 && event.sequence <= static_cast<int64_t>(solve.log.size());
    if (!known || solve.log[static_cast<size_t>(event.sequence) - 1].what != event.what) {
      return Violated(seen.id, "does not hold the acknowledged event " + Number(event.sequence) + ", " + event.what);
    }
  }
  if (call.kind == CallKind::kFinish && !IsOver(solve.last.state))
    Violated(seen.id, "has not ended, and its agent is told so");
}

void HistoryModel::ClaimAnswered(const SeenLease& lease) {
  if (claims_.erase({lease.id, lease.epoch}) == 0) {
    Violated(lease.id, "is given to " + lease.owner + " under epoch " + Number(lease.epoch) + ", which is not its own");
  }
}

void HistoryModel::CreateAnswered(const std::string& request_id, const std::string& tag, const std::string& id) {
  const auto place = solves_.find(id);
  if (place == solves_.end()) return Violated(id, "was acknowledged and is not stored");
  if (place->second.last.tag != tag) Violated(id, "answers " + tag + " and is of " + place->second.last.tag);
  const auto [request, is_new] = requests_.emplace(request_id, id);
  if (is_new || request->second == id) return;
  if (!solves_[request->second].gone) Violated(id, "answers " + request_id + ", as " + request->second + " did before");
  request->second = id;
}

void HistoryModel::CancelAnswered(const std::string& id) {
  const Solve& solve = solves_[id];
  const bool good = solve.gone || solve.last.cancel_requested || IsOver(solve.last.state);
  if (!good) Violated(id, "goes on, and its cancellation was acknowledged");
}

void HistoryModel::DeleteAnswered(const std::string& id) {
  if (!solves_[id].gone) Violated(id, "is there, and its deletion was acknowledged");
}

void HistoryModel::NotFoundAnswered(const std::string& id) {
  if (!solves_[id].gone) Violated(id, "is there, and a client was told that it is not");
}

void HistoryModel::GetAnswered(const std::string& id, int earlier, int state, const std::string& result) {
  const Solve& solve = solves_[id];
  if (IsOver(earlier) && state != earlier) Violated(id, "had ended, and is read in state " + Number(state));
  if (!IsOver(state)) return;
  if (solve.last.state != state) Violated(id, "is read in state " + Number(state) + ", which it does not have");
  if (solve.last.result != result) Violated(id, "is read with another result than it has");
}

void HistoryModel::Delivered(const std::string& id, int64_t after, const SeenEvent& event) {
  ++counts_["events delivered"];
  const Solve& solve = solves_[id];
  if (event.sequence != after + 1) {
    return Violated(id, "sends event " + Number(event.sequence) + " to a reader that has " + Number(after));
  }
  const bool held = event.sequence <= static_cast<int64_t>(solve.log.size());
  if (!held || solve.log[static_cast<size_t>(event.sequence) - 1].what != event.what) {
    Violated(id, "sends an event " + Number(event.sequence) + " that it does not hold, " + event.what);
  }
}

void HistoryModel::MachineRestarted() {
  for (auto& [id, solve] : solves_) solve.lease_least_end_us = 0;
}

void HistoryModel::Ended(const std::vector<SeenSolve>& solves, const EventsOf& events) {
  for (const SeenSolve& seen : solves) {
    const Solve& solve = solves_[seen.id];
    if (!IsOver(seen.state)) Violated(seen.id, "does not end though all faults have");
    int64_t expected = seen.trimmed;
    for (const SeenEvent& event : events(seen.number, 0)) {
      const auto index = static_cast<size_t>(expected++);
      const bool same = index < solve.log.size() && event.sequence == expected && solve.log[index].what == event.what;
      if (!same) Violated(seen.id, "holds another event " + Number(expected) + " than it did");
    }
    if (expected != seen.last_sequence) Violated(seen.id, "does not hold its last events in the end");
  }
}

}  // namespace rollgait::server
