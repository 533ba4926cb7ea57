#include "client/view/live_feed.h"

#include <utility>

namespace rollgait::client {
namespace {

// JSON has no line feed that could end the event.
std::string Event(const std::string& name, const std::string& data) {
  return "event: " + name + "\ndata: " + data + "\n\n";
}

std::string Dump(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

void LiveFeed::SetState(const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = Dump(text);
  ++states_;
  changed_.notify_all();
}

void LiveFeed::Add(const v1::Iteration& at) {
  std::string row = Dump({at.index(), at.mesh(), at.objective(), at.primal_infeasibility(), at.dual_infeasibility(),
                          at.barrier_parameter(), at.elapsed_s()});
  const std::lock_guard<std::mutex> lock(mutex_);
  iterations_.push_back(std::move(row));
  changed_.notify_all();
}

void LiveFeed::ShowIterate(const nlohmann::json& iterate) {
  std::string text = Dump(iterate);
  const std::lock_guard<std::mutex> lock(mutex_);
  iterate_ = std::move(text);
  ++iterates_;
  changed_.notify_all();
}

void LiveFeed::End() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

std::string LiveFeed::Wait(Position* position, std::chrono::milliseconds at_most) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, at_most, [&] {
    return ended_ || !position->begun || position->iterations < iterations_.size() || position->state < states_ ||
           position->iterate < iterates_;
  });
  return New(position);
}

std::string LiveFeed::New(Position* position) const {
  std::string events;
  if (!std::exchange(position->begun, true)) events += Event("begin", "null");
  if (std::exchange(position->state, states_) < states_) events += Event("state", state_);
  if (position->iterations < iterations_.size()) {
    std::string rows;
    for (size_t i = position->iterations; i < iterations_.size(); ++i)
      rows += (rows.empty() ? "" : ",") + iterations_[i];
    position->iterations = iterations_.size();
    events += Event("iterations", "[" + rows + "]");
  }
  if (std::exchange(position->iterate, iterates_) < iterates_) events += Event("iterate", iterate_);
  position->ended = ended_;
  if (ended_) events += Event("end", "null");
  return events;
}

}  // namespace rollgait::client
