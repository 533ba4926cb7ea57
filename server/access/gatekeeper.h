#ifndef ROLLGAIT_SERVER_ACCESS_GATEKEEPER_H_
#define ROLLGAIT_SERVER_ACCESS_GATEKEEPER_H_

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "server/access/access_store.h"
#include "server/access/answer_budget.h"
#include "server/access/caller.h"
#include "server/access/methods.h"
#include "server/access/quotas.h"
#include "server/base/clock.h"
#include "server/base/outcome.h"

namespace rollgait::server {

// What a call shows of its origin.
struct Presented {
  std::string authorization;     // value of the header, "Bearer rgt_..."; empty: none
  std::string certificate_name;  // tenant that a verified certificate stands for; empty: none
  std::string peer;
  std::string traceparent;  // W3C; empty: none
};

class Gatekeeper;

// The right to serve one call. Its destruction ends what the call uses of its tenant's limits.
class Admission {
 public:
  ~Admission();
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;

  const Caller& caller() const { return caller_; }
  // What makes work has been made: the call no longer counts as one that is being answered.
  void WorkIsMade() { place_.reset(); }
  // The call has made so many more than one that count towards creates_per_s (Quotas::OweCreates);
  // negative: fewer.
  void OweCreates(int count);
  // What the call's answer occupies until the client has read it.
  AnswerHold& answer() { return *answer_; }
  // Calls `end`, from another thread and within seconds, when the token is revoked or expires. It may still be called
  // at the time when the admission is destroyed.
  void WhenWithdrawn(std::function<void(const Error&)> end);

 private:
  friend class Gatekeeper;
  Admission(Gatekeeper& gatekeeper, Caller caller);

  Gatekeeper& gatekeeper_;
  const Caller caller_;
  std::unique_ptr<AnswerHold> answer_;
  std::shared_ptr<void> place_, watch_, simulation_;
  bool registered_ = false;
};

// Who may call what, in one place. Every handler passes Check, which does not block, and then Admit, which may read the
// store. Any thread may call.
class Gatekeeper {
 public:
  struct Options {
    bool require_identity = false;            // a token, or a certificate's name; false: everyone may do everything
    AnswerLimits answers = {};                // unread
    TenantLimits limits = {};                 // of tenants that have none of their own; max_running is not used
    int most_creates_at_once = 64;            // calls that make work and are being answered
    std::chrono::milliseconds recheck{2000};  // of the tokens of open streams, and of tenants' limits
  };

  // For a server that does not ask who calls.
  explicit Gatekeeper(const Options& options) : Gatekeeper(options, nullptr, nullptr) {}
  // The store and the clock outlive it.
  Gatekeeper(const Options& options, AccessStore* store, const Clock* clock);
  ~Gatekeeper();

  // What can be refused without knowing the caller: kUnavailable while draining, kResourceExhausted. The hold goes to
  // Admit.
  Outcome<std::shared_ptr<void>> Check(const MethodRule& rule, const std::string& lane = "");
  // Whose turns a call takes before its caller is known: those of the tenant whose token it shows, or whose
  // certificate. A token that has not been admitted before shares a lane with all such. Empty: nobody is asked who
  // calls. Does not block.
  std::string LaneOf(const Presented& presented);
  // kUnauthenticated, kPermissionDenied, kResourceExhausted (a quota), kUnavailable (the store).
  Outcome<std::shared_ptr<Admission>> Admit(const MethodRule& rule, const Presented& presented,
                                            std::shared_ptr<void> place);
  // Check refuses from now on.
  void Drain() { draining_ = true; }
  bool draining() const { return draining_; }
  std::shared_ptr<const AnswerBudget> answers() const { return answers_; }
  // Waits until no admission is left, at most so long. False: some are.
  bool WaitUntilLeft(std::chrono::milliseconds at_most);

 private:
  friend class Admission;
  struct KnownLimits {
    TenantLimits limits;
    std::chrono::steady_clock::time_point read;
  };

  Outcome<Caller> Identify(const Presented& presented);
  Outcome<Caller> ByToken(const Presented& presented);
  Outcome<TenantLimits> LimitsOf(const std::string& tenant);
  void AuditRefusal(const MethodRule& rule, const Presented& presented, const std::string& token_id,
                    const Error& error);
  void Watch();
  void Recheck();

  const Options options_;
  AccessStore* const store_;
  const Clock* const clock_;
  std::atomic<bool> draining_{false};
  Quotas quotas_;
  Backpressure backpressure_;
  const std::shared_ptr<AnswerBudget> answers_;

  std::mutex admissions_mutex_;
  std::condition_variable left_;
  int admissions_ = 0;

  std::mutex limits_mutex_;
  std::map<std::string, KnownLimits> known_limits_;

  std::mutex lanes_mutex_;
  std::map<std::string, std::string> tenants_of_tokens_;  // by the hash of the token

  std::mutex audit_mutex_;
  Quotas refusals_;
  int64_t refusals_left_out_ = 0;

  std::mutex streams_mutex_;  // protects what follows
  std::condition_variable stopped_;
  bool stopping_ = false;
  std::map<Admission*, std::function<void(const Error&)>> streams_;
  std::thread watcher_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_GATEKEEPER_H_
