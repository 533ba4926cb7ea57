#ifndef ROLLGAIT_SERVER_STORE_SOLVE_STORE_H_
#define ROLLGAIT_SERVER_STORE_SOLVE_STORE_H_

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/base/outcome.h"
#include "server/store/list_query.h"
#include "server/store/retention_limits.h"
#include "server/store/solve_record.h"

namespace rollgait::server {

// What can be said of a solve without reading what is long.
struct SolveExtent {
  std::string tenant;
  int64_t bytes = 0;  // of spec, result and error together
};

// What the newest attempt that kept something had come to; the bytes are the agents'.
struct StoredJournal {
  int64_t epoch = 0;  // of its lease
  std::string content;
};

// Where solves live. Every call is one transaction and durable when it returns; any number of threads and processes may
// call. Every call may also fail with kUnavailable (also: it may have happened), kResourceExhausted (no room on the
// disk) or kInternal. What a person or an agent changes leaves a row in `audit` with it.
//
// Single flight: a queued solve is not claimed while a solve of the same key runs; when that one ends with a reusable
// result, the queued ones of its key end with it (from_cache).
class SolveStore {
 public:
  virtual ~SolveStore() = default;

  // Inserts a queued solve and its first event (QUEUED); or, if a reusable result of the same key is held, a solve that
  // has succeeded from_cache. kAlreadyExists: request_id belongs to another spec or other labels. kResourceExhausted:
  // queue is full.
  virtual Outcome<CreatedSolve> Create(const NewSolve& solve) = 0;
  // Create for all of them, of one tenant, in their order, or for none. Records are without results. The message of an
  // error says which of them has it, "requests[3].".
  virtual Outcome<std::vector<CreatedSolve>> CreateAll(const std::vector<NewSolve>& solves) = 0;
  // Whether Create would have to put it in the queue: false if the tenant's request_id is known or a reusable result is
  // held. Reads only.
  virtual Outcome<bool> NeedsPlace(const NewSolve& solve) = 0;
  // kNotFound.
  virtual Outcome<SolveRecord> Get(const std::string& id) = 0;
  // Whose it is and how long Get's answer would be, without reading that. kNotFound.
  virtual Outcome<SolveExtent> Extent(const std::string& id) = 0;
  // kInvalidArgument: page_token is not one of ours or belongs to another query.
  virtual Outcome<SolvePage> List(const ListQuery& query) = 0;
  // Removes a solve, its events, and its result unless another solve shares it. kNotFound, kFailedPrecondition: not
  // terminal.
  virtual Outcome<Done> Delete(const std::string& id, const Actor& actor = {}) = 0;
  // Queued: ends it at once as kCancelled. Running: sets the flag. Terminal: nothing. Returns the solve. kNotFound.
  virtual Outcome<SolveRecord> RequestCancel(const std::string& id, const Actor& actor = {}) = 0;
  // Of a queued solve: among those of its tenant; nothing if it has this one, queued or not. Returns the solve.
  // kNotFound, kFailedPrecondition: not queued.
  virtual Outcome<SolveRecord> SetPriority(const std::string& id, int priority, const Actor& actor = {}) = 0;
  // Events with a larger number, at most max_events (0: only the numbers). kNotFound, kOutOfRange: after_sequence is
  // beyond the newest, negative, or before the oldest held (retention), which the message names.
  virtual Outcome<EventPage> ReadEvents(const std::string& id, int64_t after_sequence, int max_events) = 0;
  // The numbers of the newest events of these solves, in one snapshot; those that do not exist are left out.
  virtual Outcome<std::map<std::string, int64_t>> LastSequences(const std::vector<std::string>& ids) = 0;
  // The id of the solve that stands nearest; empty: none is near enough.
  virtual Outcome<std::string> Nearest(const NearQuery& query) = 0;
  // Solves without a place and with a larger number, in order, at most `most`; and gives them theirs.
  virtual Outcome<std::vector<UnplacedSolve>> Unplaced(int64_t after_number, int most) = 0;
  virtual Outcome<Done> SetPlaces(const std::vector<PlacedSolve>& solves) = 0;
  virtual Outcome<SolveCounts> Counts(const std::optional<std::string>& tenant = std::nullopt) = 0;
  // Rows with a larger number, in order, at most max_rows.
  virtual Outcome<std::vector<AuditRow>> ReadAudit(int64_t after_number, int max_rows) = 0;
  // One small step towards the limits, oldest first: what was removed, nothing if all is within them. Solves that have
  // not finished stay; so do results that a solve within the limits shares.
  virtual Outcome<Removed> Retain(const RetentionLimits& limits) = 0;

  // For agents.

  // Takes the queued solve whose turn it is (fair_order.h) of those that may run (single flight, the tenant's
  // max_running): attempts + 1, RUNNING and its event. nullopt: none.
  virtual Outcome<std::optional<ClaimedSolve>> ClaimNext(const std::string& owner,
                                                         std::chrono::milliseconds duration) = 0;
  // Prolongs from now on. kLeaseLost.
  virtual Outcome<LeaseState> RenewLease(const Lease& lease, std::chrono::milliseconds duration) = 0;
  // Appends in order. An event whose `sequence` is given (not 0) and not beyond the newest is held already: so a call
  // whose answer was lost can be made again. kLeaseLost: nothing was written.
  virtual Outcome<LeaseState> AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) = 0;
  // The same for several solves in one transaction: an outcome for each.
  virtual Outcome<std::vector<Outcome<LeaseState>>> AppendAll(const std::vector<EventBatch>& batches) = 0;
  // Appends `events`, then writes result or error, state and the terminal event, all in one transaction. kLeaseLost.
  virtual Outcome<Done> Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) = 0;
  // Keeps what an attempt has come to, in place of what there was, until the solve ends: for the next attempt, wherever
  // that runs. kLeaseLost: nothing was written.
  virtual Outcome<Done> PutJournal(const Lease& lease, const std::string& journal) = 0;
  // nullopt: none is kept, or there is no such solve.
  virtual Outcome<std::optional<StoredJournal>> ReadJournal(const std::string& id) = 0;
  // Gives a solve up. Returns the state it is in now: kQueued, kFailed (too many crashes), kCancelled (that was asked
  // for). kLeaseLost.
  virtual Outcome<SolveState> GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) = 0;
  // Solves of this owner that are to be cancelled.
  virtual Outcome<std::vector<std::string>> CancelRequests(const std::string& owner) = 0;
  // Owners that hold leases now, expired or not.
  virtual Outcome<std::vector<LeaseOwner>> LeaseOwners() = 0;
  // Puts the running solves whose lease has expired (or is of an earlier boot) back into the queue (or ends them, if
  // they were to be cancelled). Not counted as a crash. Returns their ids.
  virtual Outcome<std::vector<std::string>> ReclaimExpired() = 0;
  // The same for all running solves of an owner that is known to be dead.
  virtual Outcome<std::vector<std::string>> ReclaimOwner(const std::string& owner) = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SOLVE_STORE_H_
