#ifndef ROLLGAIT_SERVER_AGENT_AGENT_H_
#define ROLLGAIT_SERVER_AGENT_AGENT_H_

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/agent/solve_run.h"
#include "server/agent/solver_process.h"
#include "server/agent/spool.h"
#include "server/base/clock.h"
#include "server/base/data_dir.h"
#include "server/base/file_lock.h"
#include "server/base/hint_channel.h"
#include "server/base/iterate_files.h"
#include "server/base/notify.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// Works on the solves of a store: claims them under a lease, runs each in a process of its own, relays events, kills.
// One loop in one thread. See data_dir.h for how it lives and dies beside rollgaitd and other agents. What it does
// depends on the times it is given alone; Run and Step are the loop with the machine's clock and descriptors around it.
class Agent {
 public:
  struct Options {
    std::string work_dir;  // locks and spool; rollgaitd's data directory when the store is SQLite
    // Every agent of the store has its lock in work_dir: an owner without one is dead. False: it may live elsewhere,
    // and journals are in the store, too.
    bool all_agents_here = true;
    int slots = 1;  // solves at once, those of agents that drain in this directory included
    SolverProcess::Options solver;
    std::string solver_fingerprint = {};  // SHA-256 of the solver; see SolveRun::Context
    std::chrono::milliseconds lease = kLeaseDuration;
    std::chrono::milliseconds look{kNotifyPollMillis};  // between looks into the store without a hint
    int stop_fd = -1;                                   // readable: stop the solvers, give their solves back
    int lifeline_fd = -1;                               // at its end: claim nothing more, finish what runs
    std::chrono::milliseconds kill_after{2000};         // see SolveRun::Context; a stop takes a second more at most
    std::chrono::milliseconds wall_grace{60'000};
    size_t max_event_bytes = size_t{16} << 20;
    std::string owner = {};  // of its leases; unique among all agents of the store; empty: made up
  };

  // What it works with; outlives it.
  struct Surroundings {
    SolveStore& store;
    HintChannel& hints;
    const Clock& clock;
    // A solver that waits for its request; empty: a process of options.solver.
    std::function<Outcome<std::unique_ptr<RunningSolver>>()> start_solver = {};
  };
  // Takes its place in the work directory (lock, spool). kUnavailable with the reason.
  static Outcome<std::unique_ptr<Agent>> Create(const Options& options, const Surroundings& surroundings);
  ~Agent();

  // Works until it is told to stop or has nothing left to finish.
  void Run();
  // One turn of the loop, waiting at most so long. False: it is time to go.
  bool Step(std::chrono::milliseconds at_most);

  // The parts of these, without waiting. Start is called once, before the first turn.
  void Start();
  // Does what is due at a time, which never goes back. False: it is time to go.
  bool Turn(SteadyTime now);
  // When the next turn is due though nobody sends anything.
  SteadyTime NextDue(SteadyTime now) const;
  // From now on the solvers keep what they have come to; Turn gives their solves back and returns false in the end.
  void Stop(SteadyTime now);
  // Claims nothing more.
  void Drain();

  const std::string& owner() const { return owner_; }
  int running() const { return static_cast<int>(runs_.size()); }
  // Process ids of the solvers that are ready for work.
  std::vector<pid_t> IdleProcesses() const;

 private:
  Agent(const Options& options, const Surroundings& surroundings, std::string owner, FileLock lock, Spool spool);

  void Wait(std::chrono::milliseconds at_most);
  void ServiceRuns(SteadyTime now);
  void StoreEvents(SteadyTime now);
  bool GoOnStopping(SteadyTime now);
  void RemoveOldJournals();
  void RemoveOldIterates();
  static void StoreFailed(const char* wanted, const Error& error);
  bool LivesElsewhere(const std::string& owner) const;
  int RunByDrainingAgents();
  void LookAfterOthers(SteadyTime now);
  void ReclaimDeadOwners();
  void ReplayDead(const std::string& known_dead);
  void LookForCancels();
  void KeepIdleProcesses(SteadyTime now);
  void HearIdleProcesses(SteadyTime now);
  void ClaimWork(SteadyTime now);
  void GiveUpAll();

  const Options options_;
  SolveStore& store_;
  const std::string owner_;
  FileLock lock_;
  const Spool spool_;
  const IterateFiles iterates_;
  HintChannel& hints_;
  const SolveRun::Context context_;
  std::vector<std::unique_ptr<SolveRun>> runs_;
  const std::function<Outcome<std::unique_ptr<RunningSolver>>()> start_solver_;
  struct IdleProcess {
    std::unique_ptr<RunningSolver> process;
    SteadyTime since;
    bool ready = false;  // it has said so
  };
  std::deque<IdleProcess> idle_;
  bool stopping_ = false, draining_ = false;
  bool poked_ = true;  // look into the store at once
  SteadyTime look_at_, reclaim_at_, spawn_at_, stop_end_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_AGENT_H_
