#include "tests/schedules/world.h"

#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

constexpr VirtualTime kLongestEnd = 120 * kSecond;  // for all to end after the faults

ServiceOptions OptionsFor(World& world) {
  ServiceOptions options;
  options.version = "test";
  options.solver_build = "virtual";
  options.new_id = [&world] { return "s" + std::to_string(++world.solve_count); };
  return options;
}

}  // namespace

// Each kind of fault is there in some of the runs, rare or frequent.
Plan::Plan(SeededNumbers& random) {
  const auto some = [&random](double in_runs, double most) {
    return random.Chance(in_runs) ? most * static_cast<double>(1 + random.Below(10)) / 10 : 0.0;
  };
  constexpr std::array kYields = {0.02, 0.1, 0.5, 1.0};
  rates.yield = kYields[static_cast<size_t>(random.Below(static_cast<int>(kYields.size())))];
  rates.crash = some(0.4, 0.02);
  rates.lose = some(0.3, 0.02);
  rates.slow = some(0.3, 0.01);
  rates.unanswered = some(0.4, 0.2);
  rates.undone = some(0.3, 0.1);
  rates.crash_at_commit = some(0.4, 0.1);
  manners = {.crash = some(0.4, 0.5),
             .error = some(0.3, 0.3),
             .garbage = some(0.2, 0.2),
             .not_optimal = some(0.3, 0.5),
             .deaf = some(0.3, 1)};
  hint_loss = some(0.5, 1);
  answer_loss = some(0.4, 0.3);
  freeze = some(0.3, 0.05);
  stop = some(0.3, 0.03);
  shared_directory = random.Chance(0.5);
  retain = random.Chance(0.3);
  chaos = random.Chance(0.5);
  calm_after = random.Between(kSecond, 6 * kSecond);
  clients = 1 + random.Below(3);
  crowd = random.Chance(0.3);
}

ServerLife::ServerLife(World& world)
    : process(std::make_shared<Process>()),
      store(world.lab.store(Laboratory::kServer), world.recorder),
      hints(world.inboxes[Laboratory::kServer],
            [&world](const std::string& text) {
              for (size_t agent = 0; agent < Laboratory::kAgents; ++agent) world.Hint(agent, text);
            }),
      hub(store, hints, std::chrono::hours(1000), IterateFiles(world.lab.IteratesDir()), WatchHub::Drive::kCaller),
      service(store, world.lab.store(Laboratory::kServer), SmallKnowledge(), OptionsFor(world),
              [this, &world](const std::string& id) {
                hub.Changed(id);
                world.Hint(Laboratory::kServer, id);
                hints.Send(id);
              }) {
  world.lab.site(Laboratory::kServer).process = process;
}

World::World(Laboratory& laboratory, uint64_t seed, PlantedBug planted)
    : lab(laboratory),
      scheduler(seed, laboratory.stacks()),
      plan(scheduler.random()),
      bug(planted),
      rates(plan.rates),
      calm_at(scheduler.now() + plan.calm_after),
      recorder{scheduler, model, laboratory.bed().view()} {
  for (const SeenTenant& tenant : kTenants) model.SetWeight(tenant.name, tenant.weight);
  model.SetClaimers(lab.bed().one_writer() ? 1 : 2 * static_cast<int>(Laboratory::kAgents));
  recorder.ignore_epochs = bug == PlantedBug::kLeaseWithoutEpoch;
  for (size_t process = 0; process <= Laboratory::kAgents; ++process) {
    Site& site = lab.site(process);
    site.scheduler = &scheduler;
    site.process = std::make_shared<Process>();
    site.rates = &rates;
    site.lock = lab.bed().one_writer() ? &lab.lock() : nullptr;
    site.committed = [this] {
      recorder.Committed();
      if (model.violation()) Finish();
    };
    site.keep_time = [this] { lab.bed().SetTime(scheduler.now()); };
    site.one_queue = bug == PlantedBug::kOneQueue;
    site.oldest_first = bug == PlantedBug::kOldestFirst;
    site.events_after_commit = bug == PlantedBug::kEventAfterCommit;
  }
}

void World::Populate() {
  for (size_t agent = 0; agent < Laboratory::kAgents; ++agent) {
    actors[agent] = scheduler.Add("agent " + std::to_string(agent), [this, agent] { LiveAsAgent(*this, agent); });
  }
  actors[Laboratory::kServer] = scheduler.Add("server", [this] { LiveAsServer(*this); });
  clients_at_work = plan.clients;
  for (int number = 0; number < plan.clients; ++number) {
    scheduler.Add("client " + std::to_string(number), [this, number] { LiveAsClient(*this, number); });
  }
  if (plan.retain) scheduler.Add("sweeper", [this] { LiveAsSweeper(*this); });
  if (plan.chaos) scheduler.Add("chaos", [this] { LiveAsChaos(*this); });
  scheduler.Add("judge", [this] { LiveAsJudge(*this); });
}

void World::Hint(size_t process, const std::string& text) {
  if (!is_calm() && scheduler.random().Chance(plan.hint_loss)) return;
  inboxes[process].push_back(text);
  scheduler.Wake(actors[process]);
}

void World::Complain(const std::string& what) {
  scheduler.Note("VIOLATION: " + what);
  if (complaint.empty()) complaint = what;
}

void World::Finish() {
  over = true;
  for (size_t process = 0; process <= Laboratory::kAgents; ++process) lab.site(process).process->dead = true;
  scheduler.WakeAll();
}

void LiveAsServer(World& world) {
  Scheduler& scheduler = world.scheduler;
  while (!world.over) {
    world.inboxes[Laboratory::kServer].clear();
    const auto life = world.server = std::make_shared<ServerLife>(world);
    scheduler.Note("starts");
    VirtualTime look_at = scheduler.now();
    try {
      while (!world.over && !life->process->dead) {
        const bool look = scheduler.now() >= look_at;
        if (look) look_at = scheduler.now() + kSecond;
        life->hub.Turn(look);
        scheduler.SleepUntil(look_at);
      }
    } catch (const Crashed&) {
    }
    life->process->dead = true;
    world.server.reset();
    scheduler.Note("has ended");
    if (!world.over) scheduler.Freeze(scheduler.random().Between(0, 2 * kSecond));
  }
}

void LiveAsSweeper(World& world) {
  using std::chrono::seconds;
  const RetentionLimits limits{.solves = seconds(4), .events = seconds(1), .audit = seconds(2)};
  while (!world.over) {
    world.scheduler.Sleep(world.scheduler.random().Between(300 * kMillisecond, 3 * kSecond));
    const std::shared_ptr<ServerLife> life = world.server;
    if (life == nullptr || life->process->dead) continue;
    try {
      (void)life->store.Retain(limits);
    } catch (const Crashed&) {
    }
  }
}

void LiveAsChaos(World& world) {
  Scheduler& scheduler = world.scheduler;
  SeededNumbers& random = scheduler.random();
  while (!world.is_calm() && !world.over) {
    scheduler.Sleep(random.Between(100 * kMillisecond, 2 * kSecond));
    Site& site = world.lab.site(static_cast<size_t>(random.Below(Laboratory::kAgents + 1)));
    switch (random.Below(5)) {
      case 0:
        scheduler.Note("kills a process");
        site.process->dead = true;
        scheduler.WakeAll();
        break;
      case 1:
        scheduler.Note("cuts a process off");
        site.process->cut_off_until = scheduler.now() + random.Between(kSecond, 6 * kSecond);
        break;
      case 2:
        scheduler.Note("sets the date");
        world.lab.clock().wall_offset += random.Between(-3600, 3600) * kSecond;
        break;
      case 3:
        scheduler.Note("suspends the machine");
        scheduler.Jump(random.Between(kSecond, 30 * kSecond));
        break;
      default:
        scheduler.Note("restarts the machine");
        for (size_t process = 0; process <= Laboratory::kAgents; ++process)
          world.lab.site(process).process->dead = true;
        if (world.lab.bed().one_writer()) {
          world.lab.clock().boots += 1;
          world.lab.clock().boot_at = scheduler.now();
          world.model.MachineRestarted();
        }
        scheduler.WakeAll();
    }
  }
}

void LiveAsJudge(World& world) {
  Scheduler& scheduler = world.scheduler;
  scheduler.SleepUntil(world.calm_at);
  while (!world.is_calm() && !world.over) scheduler.SleepUntil(world.calm_at);
  scheduler.Note("all faults have ended");
  const double yield = world.rates.yield;
  world.rates = FaultRates();
  world.rates.yield = yield;
  for (size_t process = 0; process <= Laboratory::kAgents; ++process)
    world.lab.site(process).process->cut_off_until = 0;
  const VirtualTime end = scheduler.now() + kLongestEnd;
  while (scheduler.now() < end && !world.over && !(world.clients_at_work == 0 && world.model.AllEnded())) {
    scheduler.Sleep(300 * kMillisecond);
  }
  if (world.over) return;
  if (world.clients_at_work > 0) world.Complain("a client still waits two minutes after the last fault");
  world.Finish();
}

}  // namespace rollgait::server
