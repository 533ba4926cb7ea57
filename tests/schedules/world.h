#ifndef ROLLGAIT_TESTS_SCHEDULES_WORLD_H_
#define ROLLGAIT_TESTS_SCHEDULES_WORLD_H_

#include <array>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/base/hint_channel.h"
#include "server/service/solve_service.h"
#include "server/service/watch_hub.h"
#include "tests/schedules/laboratory.h"
#include "tests/schedules/recorded_store.h"
#include "tests/schedules/virtual_solver.h"

namespace rollgait::server {

// Mistakes in the protocol that the schedules must find.
enum class PlantedBug { kNone, kLeaseWithoutEpoch, kEventAfterCommit, kRetryWithoutRequestId, kOldestFirst, kOneQueue };

// What may happen in one run, chosen by its seed: few kinds of faults in most, all in some.
struct Plan {
  explicit Plan(SeededNumbers& random);

  FaultRates rates;
  VirtualSolver::Manners manners;
  double hint_loss = 0, answer_loss = 0, freeze = 0, stop = 0;
  bool shared_directory = true;  // both agents; else each has its own, as on two machines
  bool retain = false;
  bool chaos = false;          // kills, cuts, clocks, restarts of the machine
  VirtualTime calm_after = 0;  // faults end
  int clients = 1;
  bool crowd = false;  // of requests: they wait for one another
};

// Hints that arrive at once or not at all.
class VirtualHints : public HintChannel {
 public:
  VirtualHints(std::vector<std::string>& inbox, std::function<void(std::string)> send)
      : inbox_(inbox), send_(std::move(send)) {}
  int fd() const override { return -1; }
  std::vector<std::string> Drain() override { return std::exchange(inbox_, {}); }
  void Send(std::string_view text) override { send_(std::string(text)); }

 private:
  std::vector<std::string>& inbox_;
  const std::function<void(std::string)> send_;
};

struct World;

// One life of rollgaitd. Whoever calls it holds it until the call is over.
struct ServerLife {
  explicit ServerLife(World& world);

  std::shared_ptr<Process> process;
  RecordedStore store;
  VirtualHints hints;
  WatchHub hub;
  SolveService service;
};

// All that the actors of one run share.
struct World {
  World(Laboratory& laboratory, uint64_t seed, PlantedBug bug);

  // Adds clients, agents, the server, who disturbs them and who decides when it is over.
  void Populate();
  bool is_calm() const { return scheduler.now() >= calm_at; }
  // To one process; it may be lost.
  void Hint(size_t process, const std::string& text);
  // Something that no answer can be right about.
  void Complain(const std::string& what);
  // Everybody is to end at once.
  void Finish();

  Laboratory& lab;
  Scheduler scheduler;
  const Plan plan;
  const PlantedBug bug;
  FaultRates rates;  // of the moment
  VirtualTime calm_at;
  HistoryModel model;
  Recorder recorder;
  std::shared_ptr<ServerLife> server;  // null: none runs
  std::array<std::shared_ptr<Process>, Laboratory::kAgents> agents;
  std::array<std::vector<std::string>, Laboratory::kAgents + 1> inboxes;
  std::array<Scheduler::ActorId, Laboratory::kAgents + 1> actors = {};
  std::array<std::set<VirtualSolver*>, Laboratory::kAgents> solvers;
  int solver_count = 0, solve_count = 0, clients_at_work = 0;
  bool over = false;
  std::string complaint;  // empty: none
};

// The bodies of the actors.
void LiveAsAgent(World& world, size_t agent);
void LiveAsServer(World& world);
void LiveAsSweeper(World& world);
void LiveAsClient(World& world, int number);
void LiveAsChaos(World& world);
void LiveAsJudge(World& world);

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_WORLD_H_
