#ifndef ROLLGAIT_SERVER_ACCESS_QUOTAS_H_
#define ROLLGAIT_SERVER_ACCESS_QUOTAS_H_

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "server/access/caller.h"
#include "server/base/outcome.h"

namespace rollgait::server {

// What tenants use of this server now, held against their limits, in memory. Any thread may call; nothing blocks.
class Quotas {
 public:
  using Clock = std::chrono::steady_clock;
  using Now = std::function<Clock::time_point()>;

  explicit Quotas(Now now = Clock::now) : now_(std::move(now)) {}

  // Takes one creation from the tenant's bucket, which holds two seconds' worth, at least one. kResourceExhausted with
  // the quota and the time until there is one.
  std::optional<Error> TakeCreate(const std::string& tenant, double creates_per_s);
  // So many more that were made with the one taken: the next TakeCreate waits until they would have been made one by
  // one. Negative: so many fewer.
  void OweCreates(const std::string& tenant, double creates_per_s, int count);
  // Takes a watch until the hold is released. kResourceExhausted.
  Outcome<std::shared_ptr<void>> TakeWatch(const std::string& tenant, int max_watches);
  int watches(const std::string& tenant) const;
  // Likewise a simulation.
  Outcome<std::shared_ptr<void>> TakeSimulation(const std::string& tenant, int max_simulations);

 private:
  struct Bucket {
    double level = 0;
    Clock::time_point filled;
  };
  // What is under way, by tenant.
  struct Counts {
    std::mutex mutex;
    std::map<std::string, int> of;
  };
  // nullptr: the tenant has `most` already; 0: no limit.
  static std::shared_ptr<void> TakeOne(const std::shared_ptr<Counts>& counts, const std::string& tenant, int most);

  const Now now_;
  std::mutex mutex_;  // protects what follows
  std::map<std::string, Bucket> buckets_;
  const std::shared_ptr<Counts> watches_ = std::make_shared<Counts>();
  const std::shared_ptr<Counts> simulations_ = std::make_shared<Counts>();
};

// Refuses calls that make work when too many of them are being answered. Any thread may call; nothing blocks.
class Backpressure {
 public:
  explicit Backpressure(int most_at_once) : most_at_once_(most_at_once) {}

  // A place for one call until the hold is released; a lane with a name (Gatekeeper::LaneOf) has at most three
  // quarters of the places. kResourceExhausted.
  Outcome<std::shared_ptr<void>> Enter(const std::string& lane = "");

 private:
  // Calls that are being answered.
  struct Inside {
    std::mutex mutex;
    int all = 0;
    std::map<std::string, int> of;
  };
  const int most_at_once_;
  const std::shared_ptr<Inside> inside_ = std::make_shared<Inside>();
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_QUOTAS_H_
