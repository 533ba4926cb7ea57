#ifndef ROLLGAIT_TESTS_SCHEDULES_HISTORY_MODEL_H_
#define ROLLGAIT_TESTS_SCHEDULES_HISTORY_MODEL_H_

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/schedules/store_view.h"

namespace rollgait::server {

// A lease as an agent believes to have it.
struct SeenLease {
  std::string id = {}, owner = {};
  int64_t epoch = 0;
};

// What an actor asks of the store; the model hears of it before, at each of its commits, and when it is answered.
struct StoreCall {
  enum class Kind {
    kOther,
    kCreate,
    kCancel,
    kSetPriority,
    kDelete,
    kRetain,
    kClaim,
    kRenew,
    kAppend,
    kFinish,
    kPutJournal,
    kGiveBack,
    kReclaimExpired,
    kReclaimOwner
  };
  Kind kind = Kind::kOther;
  std::vector<std::string> tags = {};               // kCreate: of the solves
  std::string id = {};                              // kCancel, kSetPriority, kDelete
  std::string owner = {};                           // kClaim, kReclaimOwner
  std::vector<SeenLease> leases = {};               // kRenew, kAppend, kFinish, kPutJournal, kGiveBack
  std::vector<std::vector<SeenEvent>> events = {};  // of each lease, as they are handed over
  std::string result = {};                          // kFinish: what a solve that succeeded has
  int64_t lease_us = 0;                             // kClaim, kRenew: how long the lease is to last
  int64_t began_us = 0;                             // set by Begin
  std::vector<bool> held = {};                      // set by Begin: whether each lease was held then
};

// What the service promises, written down a second time: it hears what was asked and answered, sees what the database
// holds after every commit, and says where the two differ. Shares no code with the store.
class HistoryModel {
 public:
  using EventsOf = std::function<std::vector<SeenEvent>(int64_t number, int64_t after_sequence)>;

  // The share of a tenant; of others it is 1. How many claims may be under way at the same time.
  void SetWeight(const std::string& tenant, int weight) { weights_[tenant] = weight; }
  void SetClaimers(int claimers) { claimers_ = claimers; }

  // The first thing that broke a promise, as a sentence.
  const std::optional<std::string>& violation() const { return violation_; }

  // What the store is asked, and what it holds after each commit of that.
  void Begin(StoreCall& call, int64_t now_us) const;
  void Committed(const StoreCall& call, int64_t now_us, const std::vector<SeenSolve>& solves, const EventsOf& events);
  // What agents are told.
  void LeasedAnswered(const StoreCall& call, size_t lease, bool lost);
  void ClaimAnswered(const SeenLease& lease);
  // What clients do and are told.
  void CancelAsked(const std::string& id) { cancel_asked_.insert(id); }
  void DeleteAsked(const std::string& id) { delete_asked_.insert(id); }
  void CreateAnswered(const std::string& request_id, const std::string& tag, const std::string& id);
  void CancelAnswered(const std::string& id);
  void DeleteAnswered(const std::string& id);
  void NotFoundAnswered(const std::string& id);
  // `earlier`: what StateOf said before the call.
  void GetAnswered(const std::string& id, int earlier, int state, const std::string& result);
  // The reader had the events up to `after` before.
  void Delivered(const std::string& id, int64_t after, const SeenEvent& event);
  // What is known of the world.
  void OwnerDied(const std::string& owner) { dead_owners_.insert(owner); }
  void MachineRestarted();
  // After faults have ended and everybody had time to finish. All that the database holds is read again.
  void Ended(const std::vector<SeenSolve>& solves, const EventsOf& events);

  // 0: it is not there.
  int StateOf(const std::string& id) const;
  // The last event that is no longer held; 0: none.
  int64_t TrimmedOf(const std::string& id) const;
  // The lease that is held now, if one is.
  std::optional<SeenLease> LeaseOf(const std::string& id) const;
  bool AllEnded() const;
  // How often what happened.
  const std::map<std::string, int64_t>& counts() const { return counts_; }

 private:
  struct Solve {
    SeenSolve last;
    std::vector<SeenEvent> log;  // all that were ever held
    int newest_iteration = -1;   // of any attempt
    bool gone = false;
    int64_t lease_least_end_us = 0;
  };

  void Violated(const std::string& id, const std::string& what);
  bool Holds(const SeenLease& lease) const;
  void Appear(const StoreCall& call, const SeenSolve& seen, const EventsOf& events);
  void Change(const StoreCall& call, int64_t now_us, Solve& solve, const SeenSolve& seen, const EventsOf& events);
  void CheckTransition(const StoreCall& call, int64_t now_us, const Solve& solve, const SeenSolve& seen);
  void CheckEnd(const StoreCall& call, const SeenSolve& earlier, const SeenSolve& seen);
  void CheckLog(Solve& solve, const SeenSolve& seen, const EventsOf& events);
  void Vanish(const StoreCall& call, Solve& solve);
  void CheckTogether(const StoreCall& call);
  // Whether a claim took the solve whose turn it was; `solves` are those after it.
  void CheckTurn(const std::vector<SeenSolve>& solves);
  bool CouldRun(const SeenSolve& waiting) const;
  int WeightOf(const std::string& tenant) const;
  static const SeenLease* LeaseIn(const StoreCall& call, const std::string& id);

  std::optional<std::string> violation_;
  std::map<std::string, Solve> solves_;
  std::map<std::string, std::string> requests_;  // request_id to solve
  std::set<std::pair<std::string, int64_t>> claims_;
  std::map<std::string, std::set<std::string>> results_;  // of a key
  std::set<std::string> cancel_asked_, delete_asked_, dead_owners_;
  std::map<std::string, int> weights_;
  int claimers_ = 1;
  // By tenant, who waits: the claims of others since it was served or began to wait.
  std::map<std::string, std::map<std::string, int>> passed_;
  std::map<std::string, int64_t> counts_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_HISTORY_MODEL_H_
