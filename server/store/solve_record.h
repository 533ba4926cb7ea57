#ifndef ROLLGAIT_SERVER_STORE_SOLVE_RECORD_H_
#define ROLLGAIT_SERVER_STORE_SOLVE_RECORD_H_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/store/audit.h"
#include "server/store/labels.h"
#include "server/store/solve_place.h"

namespace rollgait::server {

// The numbers of rollgait.v1.SolveState.
enum class SolveState { kQueued = 1, kRunning = 2, kSucceeded = 3, kFailed = 4, kCancelled = 5 };

inline bool IsTerminal(SolveState state) { return state >= SolveState::kSucceeded; }

// One solve as it is stored. Blobs are serialized protobuf.
struct SolveRecord {
  std::string id;         // "solves/{id}" without the prefix
  std::string spec;       // v1::SolveSpec
  std::string solve_key;  // equal keys: equal answers; empty: equal to nothing
  std::string tenant;     // whose it is; empty: of a server without authentication
  // The solver that the key was made for (SHA-256 of the program); a result of another is not reused. Empty: of any.
  std::string solver_fingerprint;
  std::string traceparent;  // W3C; of the call that made it
  SolveState state = SolveState::kQueued;
  int64_t create_time_us = 0, start_time_us = 0, end_time_us = 0;  // wall clock, µs since 1970; 0: not yet
  int attempts = 0;                                                // how often it was claimed
  int crashes = 0;                                                 // how often its solver process died
  bool cancel_requested = false;
  bool from_cache = false;
  int64_t last_sequence = 0;     // number of its newest event
  int64_t trimmed_sequence = 0;  // events up to here are no longer held
  // v1::SolveResult. Empty unless kSucceeded, or a program of the request had converged: then it is the newest
  // solution.
  std::string result;
  // What the result says, also where it is left out: v1::Termination, v1::Verdict. 0: no result, or written before they
  // were kept.
  int termination = 0, verdict = 0;
  std::string error;  // v1::SolveError; empty unless kFailed or kCancelled
  Labels labels = {};
  int priority = 0;  // among the queued ones of its tenant; the highest is claimed first
};

// Of a solve.
inline constexpr int kLeastPriority = -10, kMostPriority = 10;

struct NewSolve {
  std::string id;          // unique, chosen by the caller
  std::string request_id;  // of its tenant; empty: none
  std::string spec;
  std::string solve_key;
  int max_queued = 1000;         // refuse with kResourceExhausted if so many are queued already
  std::string warm_start = {};   // wire::WarmStart, kept until the solve ends; empty: none
  Actor actor = {};              // its tenant is the solve's
  int max_queued_tenant = 0;     // the same limit for the tenant alone; 0: none
  int64_t max_bytes_tenant = 0;  // refuse likewise if what the tenant stores takes more with this one; 0: no limit
  std::string solver_fingerprint = {}, traceparent = {};
  SolvePlace place = {};
  Labels labels = {};
  std::string model = {};  // what lists filter by: the name, or "own"
  int priority = 0;
};

struct CreatedSolve {
  SolveRecord record;
  bool created = true;  // false: the request_id was known and this is the solve made for it
};

enum class EventKind { kStateChange = 1, kIteration = 2, kFinished = 3, kIntermediate = 4 };

// One event. `payload` is a serialized v1::SolveEvent with its time, without sequence. For kFinished the field
// `finished` is not in the payload either: whoever reads builds it from the record.
struct StoredEvent {
  int64_t sequence = 0;  // 1, 2, 3 … within a solve, over all attempts; assigned by the store
  EventKind kind = EventKind::kIteration;
  std::string payload;
};

struct EventPage {
  std::vector<StoredEvent> events;  // in order, dense
  int64_t last_sequence = 0;        // newest event of the solve, on this page or not
  SolveState state = SolveState::kQueued;
};

// The right to write to a running solve. A new claim has a larger epoch, and writes under an older one change nothing.
struct Lease {
  std::string solve_id;
  std::string owner;
  int64_t epoch = 0;
};

// Events of one leased solve.
struct EventBatch {
  Lease lease;
  std::vector<StoredEvent> events;
  // v1::SolveResult: takes the place of the solution that the solve has so far; empty: that stays.
  std::string solution = {};
};

struct ClaimedSolve {
  Lease lease;
  SolveRecord record;
  std::string warm_start;  // as in NewSolve
};

struct LeaseState {
  bool cancel_requested = false;
  int64_t last_sequence = 0;
};

// How a run ended.
struct SolveEnd {
  SolveState state = SolveState::kSucceeded;  // terminal
  std::string result;                         // v1::SolveResult; if not kSucceeded the newest solution, or empty
  std::string error;                          // v1::SolveError else
  bool reusable = false;                      // may answer equal requests (termination is OPTIMAL)
};

enum class GiveBackReason {
  kStopping,    // the agent stops: back to the queue
  kNeverBegan,  // the solver was killed before the request arrived: back to the queue
  kCrashed,     // the solver process died: back to the queue, the third time kFailed with KIND_CRASH
};

struct SolveCounts {
  int queued = 0, running = 0;
  int64_t oldest_queued_us = 0;  // create_time_us; 0: none
};

struct LeaseOwner {
  std::string owner;
  int running = 0;  // solves
};

inline constexpr int kMaxCrashes = 3;
inline constexpr std::chrono::milliseconds kLeaseDuration{15'000};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SOLVE_RECORD_H_
