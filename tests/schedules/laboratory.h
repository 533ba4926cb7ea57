#ifndef ROLLGAIT_TESTS_SCHEDULES_LABORATORY_H_
#define ROLLGAIT_TESTS_SCHEDULES_LABORATORY_H_

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/base/clock.h"
#include "server/store/sql_store.h"
#include "tests/schedules/faulty_connection.h"
#include "tests/schedules/scheduler.h"
#include "tests/schedules/store_bed.h"

namespace rollgait::server {

// The scheduler's time, as clocks of a machine show it.
class VirtualClock : public Clock {
 public:
  int64_t WallMicros() const override { return 1'700'000'000'000'000 + Now() + wall_offset; }
  int64_t BootNanos() const override { return 1000 * (Now() - boot_at); }
  std::string BootId() const override { return "boot" + std::to_string(boots); }

  const Scheduler* scheduler = nullptr;
  VirtualTime wall_offset = 0, boot_at = 0;
  int boots = 0;

 private:
  VirtualTime Now() const { return scheduler == nullptr ? 0 : scheduler->now(); }
};

// What is costly to make and the same for every seed: the database, the stores of the three processes with their
// connections and prepared statements, stacks, directories. One thread.
class Laboratory {
 public:
  static constexpr size_t kAgents = 2, kServer = kAgents;
  explicit Laboratory(std::unique_ptr<StoreBed> bed);

  // As at the start: an empty store and empty directories, for runs of one scheduler.
  void Prepare(Scheduler& scheduler);
  StoreBed& bed() { return *bed_; }
  VirtualClock& clock() { return clock_; }
  WriterLock& lock() { return lock_; }
  std::vector<std::unique_ptr<FiberStack>>& stacks() { return stacks_; }
  // Of the agents 0 and 1 and of the server.
  Site& site(size_t process) { return places_[process]->site; }
  SqlStore& store(size_t process) { return *places_[process]->store; }
  // Of an agent.
  std::string WorkDir(size_t agent) const { return directory_ + "/agent" + std::to_string(agent); }
  std::string IteratesDir() const { return WorkDir(0) + "/iterates"; }

 private:
  struct Place {
    Site site;
    std::unique_ptr<SqlStore> store;
  };
  std::unique_ptr<SqlConnection> Connect(Site& site);

  const std::unique_ptr<StoreBed> bed_;
  VirtualClock clock_;
  WriterLock lock_;
  std::vector<std::unique_ptr<FiberStack>> stacks_;
  std::vector<std::unique_ptr<SqlConnection>> spare_;  // connections that nobody uses
  std::string directory_;
  std::shared_ptr<void> remove_directory_;
  std::array<std::unique_ptr<Place>, kAgents + 1> places_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_LABORATORY_H_
