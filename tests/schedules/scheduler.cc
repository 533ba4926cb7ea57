#include "tests/schedules/scheduler.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/base/check.h"

namespace rollgait::server {

uint64_t SeededNumbers::Next() {
  state_ += 0x9e3779b97f4a7c15u;
  uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

Scheduler::Scheduler(uint64_t seed, std::vector<std::unique_ptr<FiberStack>>& stacks)
    : random_(seed), stacks_(stacks) {}

Scheduler::ActorId Scheduler::Add(std::string name, std::function<void()> body) {
  const size_t index = actors_.size();
  if (stacks_.size() <= index) stacks_.push_back(std::make_unique<FiberStack>());
  actors_.push_back({std::move(name), std::make_unique<Fiber>(*stacks_[index], std::move(body)), now_});
  return index;
}

std::optional<Scheduler::ActorId> Scheduler::Choose() {
  ready_.clear();
  VirtualTime first = std::numeric_limits<VirtualTime>::max();
  for (ActorId id = 0; id < actors_.size(); ++id) {
    if (actors_[id].fiber->ended()) continue;
    first = std::min(first, actors_[id].wake);
    if (actors_[id].wake <= now_) ready_.push_back(id);
  }
  if (first == std::numeric_limits<VirtualTime>::max()) return std::nullopt;
  if (ready_.empty()) {
    now_ = first;
    return Choose();
  }
  return ready_[static_cast<size_t>(random_.Below(static_cast<int>(ready_.size())))];
}

bool Scheduler::Run(int64_t most_steps) {
  while (const std::optional<ActorId> next = Choose()) {
    if (++steps_ > most_steps) return false;
    current_ = *next;
    actors_[*next].frozen = false;
    actors_[*next].fiber->Resume();
    current_.reset();
  }
  return true;
}

void Scheduler::Yield() {
  actors_[current()].wake = now_;
  actors_[current()].fiber->Suspend();
}

void Scheduler::SleepUntil(VirtualTime time) {
  actors_[current()].wake = std::max(time, now_);
  actors_[current()].fiber->Suspend();
}

void Scheduler::Freeze(VirtualTime duration) {
  actors_[current()].frozen = true;
  SleepUntil(now_ + duration);
}

void Scheduler::Wake(ActorId actor) {
  if (!actors_[actor].frozen) actors_[actor].wake = std::min(actors_[actor].wake, now_);
}

void Scheduler::WakeAll() {
  for (Actor& actor : actors_) actor.wake = std::min(actor.wake, now_);
}

void Scheduler::Note(const std::string& what) {
  if (lines_ == nullptr) return;
  char time[32];
  std::snprintf(time, sizeof time, "%10.6f s ", static_cast<double>(now_ - 3600 * kSecond) / kSecond);
  lines_->push_back(time + (current_ ? actors_[*current_].name : "-") + ": " + what);
}

}  // namespace rollgait::server
