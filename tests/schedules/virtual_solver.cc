#include "tests/schedules/virtual_solver.h"

#include <signal.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "server/base/cancel_signal.h"

namespace rollgait::server {

VirtualSolver::VirtualSolver(Scheduler& scheduler, const Manners& manners, std::set<VirtualSolver*>& living, int number)
    : scheduler_(scheduler), manners_(manners), living_(living), number_(number) {
  living_.insert(this);
  wire::SolverMessage message;
  message.mutable_ready();
  Say(scheduler_.now() + scheduler_.random().Between(0, 50 * kMillisecond), message);
}

void VirtualSolver::Say(VirtualTime at, const wire::SolverMessage& message) {
  messages_.push_back({at, message.SerializeAsString()});
}

// The second message, after the request, is what earlier attempts have left; no request here has a warm start.
void VirtualSolver::Send(std::string_view request) {
  if (++sent_ != 2) return;
  wire::Journal journal;
  if (journal.ParseFromString(std::string(request))) Begin(journal);
}

// A state under way is the number of the iteration after it.
void VirtualSolver::Begin(const wire::Journal& journal) {
  SeededNumbers& random = scheduler_.random();
  const int first = journal.started().empty() ? 0 : std::stoi(journal.started());
  VirtualTime at = scheduler_.now();
  if (first > 0) {
    wire::SolverMessage message;
    message.mutable_continuation()->set_iteration(first);
    Say(at, message);
  }
  const int last = random.Below(5);
  for (int i = first; i < last; ++i) {
    at += random.Between(0, 300 * kMillisecond);
    wire::SolverMessage message;
    message.mutable_iteration()->set_index(i);
    message.mutable_iteration()->set_objective(Nonce(i));
    Say(at, message);
    if (!random.Chance(0.3)) continue;
    message.mutable_record()->set_program(0);
    message.mutable_record()->set_started(std::to_string(i + 1));
    Say(at, message);
  }
  Conclude(at + random.Between(0, 300 * kMillisecond));
}

void VirtualSolver::Conclude(VirtualTime at) {
  SeededNumbers& random = scheduler_.random();
  end_ = at;
  if (random.Chance(manners_.crash)) {
    wait_status_ = SIGSEGV;
    return;
  }
  if (random.Chance(manners_.garbage)) {
    stream_end_ = FrameStatus::kGarbage;
    return;
  }
  wire::SolverMessage message;
  if (random.Chance(manners_.error)) {
    message.mutable_error()->set_kind(v1::SolveError::KIND_INTERNAL);
    message.mutable_error()->set_message("as planned");
  } else {
    const bool optimal = !random.Chance(manners_.not_optimal);
    message.mutable_result()->set_termination(optimal ? v1::TERMINATION_OPTIMAL : v1::TERMINATION_ITERATION_LIMIT);
    message.mutable_result()->set_message("of solver " + std::to_string(number_));
    message.mutable_result()->set_solver_build("virtual");
  }
  Say(at, message);
}

VirtualTime VirtualSolver::NextAt() const {
  if (end_seen_) return std::numeric_limits<VirtualTime>::max();
  if (!messages_.empty()) return messages_.front().at;
  return end_.value_or(std::numeric_limits<VirtualTime>::max());
}

FrameStatus VirtualSolver::Receive(std::vector<std::string>* payloads) {
  while (!messages_.empty() && messages_.front().at <= scheduler_.now()) {
    payloads->push_back(std::move(messages_.front().payload));
    messages_.pop_front();
  }
  if (!messages_.empty() || !end_ || *end_ > scheduler_.now()) return FrameStatus::kNeedMore;
  end_seen_ = true;
  return stream_end_;
}

void VirtualSolver::Kill(int signal) {
  const VirtualTime now = scheduler_.now();
  if (end_ && *end_ <= now) return;
  if (signal == SIGKILL) {
    std::erase_if(messages_, [now](const Message& message) { return message.at > now; });
    end_ = now;
    wait_status_ = SIGKILL;
    return;
  }
  if (signal != kCancelSignal || sent_ < 2 || std::exchange(told_to_stop_, true)) return;
  if (scheduler_.random().Chance(manners_.deaf)) return;
  const VirtualTime at = now + scheduler_.random().Between(0, 50 * kMillisecond);
  std::erase_if(messages_, [at](const Message& message) { return message.at > at; });
  if (end_ && *end_ <= at) return;
  end_ = at;
  stream_end_ = FrameStatus::kEnd;
  wait_status_ = 0;
  wire::SolverMessage message;
  message.mutable_result()->set_termination(v1::TERMINATION_CANCELLED);
  Say(at, message);
}

std::optional<ProcessEnd> VirtualSolver::Reap() {
  if (!end_ || *end_ > scheduler_.now()) return std::nullopt;
  return ProcessEnd{wait_status_, 0.5, 1 << 20};
}

}  // namespace rollgait::server
