#include <fstream>

#include "server/agent/agent.h"
#include "server/base/data_dir.h"
#include "tests/schedules/world.h"

namespace rollgait::server {
namespace {

constexpr std::chrono::milliseconds kLease{3000}, kLook{1000};

SteadyTime At(VirtualTime time) { return SteadyTime(std::chrono::microseconds(time)); }
VirtualTime Of(SteadyTime time) {
  return std::chrono::ceil<std::chrono::microseconds>(time.time_since_epoch()).count();
}

Agent::Options OptionsFor(const World& world, size_t agent, const std::string& owner) {
  Agent::Options options;
  options.work_dir = world.lab.WorkDir(world.plan.shared_directory ? 0 : agent);
  options.all_agents_here = world.plan.shared_directory;
  options.slots = 1 + static_cast<int>(agent);
  options.lease = kLease;
  options.look = kLook;
  options.kill_after = std::chrono::milliseconds(500);
  options.owner = owner;
  return options;
}

// The agent at work, until it goes or dies.
void Work(World& world, size_t slot, Agent& agent, const Process& process) {
  Scheduler& scheduler = world.scheduler;
  SeededNumbers& random = scheduler.random();
  agent.Start();
  while (agent.Turn(At(scheduler.now()))) {
    VirtualTime due = Of(agent.NextDue(At(scheduler.now())));
    for (const VirtualSolver* solver : world.solvers[slot]) due = std::min(due, solver->NextAt());
    scheduler.SleepUntil(due);
    if (process.dead) return;
    if (world.is_calm()) continue;
    if (random.Chance(world.plan.freeze)) {
      scheduler.Note("is frozen");
      scheduler.Freeze(random.Between(kSecond, 6 * kSecond));
      if (process.dead) return;
    }
    if (!random.Chance(world.plan.stop)) continue;
    if (random.Chance(0.5)) {
      scheduler.Note("is told to stop");
      agent.Stop(At(scheduler.now()));
    } else {
      scheduler.Note("drains");
      agent.Drain();
    }
  }
}

}  // namespace

void LiveAsAgent(World& world, size_t slot) {
  Scheduler& scheduler = world.scheduler;
  RecordedStore store(world.lab.store(slot), world.recorder);
  for (int life = 0; !world.over; ++life) {
    const std::string owner = "agent" + std::to_string(slot) + "-" + std::to_string(life);
    const auto process = world.lab.site(slot).process = std::make_shared<Process>();
    VirtualHints hints(world.inboxes[slot],
                       [&world](const std::string& text) { world.Hint(Laboratory::kServer, text); });
    const auto start_solver = [&]() -> Outcome<std::unique_ptr<RunningSolver>> {
      VirtualSolver::Manners manners = world.plan.manners;
      if (world.is_calm()) manners.crash = manners.garbage = 0;
      return std::unique_ptr<RunningSolver>(
          std::make_unique<VirtualSolver>(scheduler, manners, world.solvers[slot], ++world.solver_count));
    };
    const Agent::Options options = OptionsFor(world, slot, owner);
    Outcome<std::unique_ptr<Agent>> agent = Agent::Create(options, {store, hints, world.lab.clock(), start_solver});
    ROLLGAIT_CHECK(agent.ok());
    scheduler.Note("starts as " + owner);
    try {
      Work(world, slot, *agent.value(), *process);
    } catch (const Crashed&) {
    }
    scheduler.Note("has ended");
    const bool died = process->dead;
    process->dead = true;
    world.model.OwnerDied(owner);
    agent.value().reset();
    // What a process that is killed leaves behind.
    if (died) std::ofstream(DataDir{options.work_dir}.AgentLock(owner)).flush();
    if (!world.over) scheduler.Freeze(scheduler.random().Between(0, 2 * kSecond));
  }
}

}  // namespace rollgait::server
