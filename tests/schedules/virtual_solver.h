#ifndef ROLLGAIT_TESTS_SCHEDULES_VIRTUAL_SOLVER_H_
#define ROLLGAIT_TESTS_SCHEDULES_VIRTUAL_SOLVER_H_

#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/agent/running_solver.h"
#include "server/base/wire.pb.h"
#include "tests/schedules/scheduler.h"

namespace rollgait::server {

// A solver in virtual time: takes a while, sends iterations and records, and ends with a result, an error, by a crash,
// or with bytes that are none of ours, as the scheduler's numbers say.
class VirtualSolver : public RunningSolver {
 public:
  // How often it does anything but find an optimum, in [0, 1].
  struct Manners {
    double crash = 0, error = 0, garbage = 0, not_optimal = 0;
    double deaf = 0;  // takes no notice of the signal to stop
  };
  // `living`, in which it has its place while it lives, and the scheduler outlive it. Numbers are given once each.
  VirtualSolver(Scheduler& scheduler, const Manners& manners, std::set<VirtualSolver*>& living, int number);
  ~VirtualSolver() override { living_.erase(this); }

  // When it does something next.
  VirtualTime NextAt() const;

  pid_t pid() const override { return 1000 + number_; }
  int stream_fd() const override { return -1; }
  int output_fd() const override { return -1; }
  bool wants_to_write() const override { return false; }
  void Send(std::string_view request) override;
  void Write() override {}
  FrameStatus Receive(std::vector<std::string>* payloads) override;
  void ReadOutput() override {}
  std::string LastOutput() const override { return ""; }
  void Kill(int signal) override;
  std::optional<ProcessEnd> Reap() override;

 private:
  struct Message {
    VirtualTime at;
    std::string payload;
  };
  void Say(VirtualTime at, const wire::SolverMessage& message);
  void Begin(const wire::Journal& journal);
  void Conclude(VirtualTime at);
  double Nonce(int index) const { return 1000.0 * number_ + index; }

  Scheduler& scheduler_;
  const Manners manners_;
  std::set<VirtualSolver*>& living_;
  const int number_;
  int sent_ = 0;
  std::deque<Message> messages_;
  std::optional<VirtualTime> end_;
  FrameStatus stream_end_ = FrameStatus::kEnd;
  int wait_status_ = 0;
  bool end_seen_ = false, told_to_stop_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_VIRTUAL_SOLVER_H_
