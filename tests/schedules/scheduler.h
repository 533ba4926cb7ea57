#ifndef ROLLGAIT_TESTS_SCHEDULES_SCHEDULER_H_
#define ROLLGAIT_TESTS_SCHEDULES_SCHEDULER_H_

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/schedules/fiber.h"

namespace rollgait::server {

// Numbers that follow from a seed on every machine (SplitMix64).
class SeededNumbers {
 public:
  explicit SeededNumbers(uint64_t seed) : state_(seed) {}
  uint64_t Next();
  // From 0 to count - 1; count > 0.
  int Below(int count) { return static_cast<int>(Next() % static_cast<uint64_t>(count)); }
  // From first to last, both included.
  int64_t Between(int64_t first, int64_t last) {
    return first + static_cast<int64_t>(Next() % static_cast<uint64_t>(last - first + 1));
  }
  // True with this probability, in [0, 1].
  bool Chance(double probability) { return static_cast<double>(Next() >> 11) * 0x1p-53 < probability; }

 private:
  uint64_t state_;
};

// Virtual time, in microseconds.
using VirtualTime = int64_t;
constexpr VirtualTime kMillisecond = 1000, kSecond = 1'000'000;

// Runs actors in one thread, one step of one actor at a time, in an order that follows from the seed; a step ends where
// the actor says so (Yield, Sleep). Time goes on only when no actor can: to the moment when the first one wakes.
class Scheduler {
 public:
  using ActorId = size_t;
  // The stacks are used for the actors, and more are made as needed; they outlive the scheduler.
  Scheduler(uint64_t seed, std::vector<std::unique_ptr<FiberStack>>& stacks);

  // An exception must not leave the body.
  ActorId Add(std::string name, std::function<void()> body);
  // Runs until every actor has ended. False: not within so many steps.
  bool Run(int64_t most_steps);

  // For actors.

  // Others may run now.
  void Yield();
  // Goes on at a time, or earlier when somebody wakes it. A time that has passed is now.
  void SleepUntil(VirtualTime time);
  void Sleep(VirtualTime duration) { SleepUntil(now_ + duration); }
  // The same, but nobody wakes it.
  void Freeze(VirtualTime duration);
  ActorId current() const { return *current_; }

  void Wake(ActorId actor);
  // Frozen ones, too: so nobody may rely on how long he sleeps.
  void WakeAll();
  // All clocks of steady time go forward at once, as after a sleep of the machine.
  void Jump(VirtualTime duration) { now_ += duration; }
  VirtualTime now() const { return now_; }
  SeededNumbers& random() { return random_; }
  int64_t steps() const { return steps_; }

  // Lines of what happens, if anybody wants them.
  void Trace(std::vector<std::string>* lines) { lines_ = lines; }
  bool traced() const { return lines_ != nullptr; }
  void Note(const std::string& what);

 private:
  struct Actor {
    std::string name;
    std::unique_ptr<Fiber> fiber;
    VirtualTime wake = 0;
    bool frozen = false;
  };
  // Of those that can go on now, one; nullopt: none can.
  std::optional<ActorId> Choose();

  SeededNumbers random_;
  std::vector<std::unique_ptr<FiberStack>>& stacks_;
  std::vector<Actor> actors_;
  std::vector<ActorId> ready_;
  std::optional<ActorId> current_;
  VirtualTime now_ = 3600 * kSecond;
  int64_t steps_ = 0;
  std::vector<std::string>* lines_ = nullptr;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_SCHEDULER_H_
