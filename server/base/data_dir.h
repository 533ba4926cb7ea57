#ifndef ROLLGAIT_SERVER_BASE_DATA_DIR_H_
#define ROLLGAIT_SERVER_BASE_DATA_DIR_H_

#include <string>

namespace rollgait::server {

// What lies in the data directory, and who may touch it. With solves in PostgreSQL the directory of an agent elsewhere
// (--work-dir) holds spool and agents only.
//
//   rollgait.db            SQLite store (WAL), shared by rollgaitd and its agents
//   rollgaitd.lock         flock of the one rollgaitd that serves this directory
//   rollgaitd.sock         notifications to rollgaitd: a solve has new events (notify.h)
//   agent.sock             notifications to the newest agent: a solve was created or is to be cancelled
//   spool/<id>-<epoch>.end an agent's copy of how a solve ended, until the store has it
//   spool/<id>-<epoch>.journal  what an attempt has come to, for the next one, until the solve has ended
//   iterates/<id>          the newest iterate of a running solve, for those who watch, until it has ended
//   agents/<owner>.lock    flock held by a living agent; `owner` is the owner of its leases (letters, digits, '-')
//   agents/<owner>.draining  that agent claims nothing more
//
// Life of an agent. rollgaitd starts `rollgait-agent --data-dir DIR --slots N [--solver PATH]` with standard input
// being the read end of a pipe that only rollgaitd can write to (nobody ever does).
//
// - SIGTERM: the agent stops its solvers, which keep what they have come to, gives their solves back to the queue
//   (GiveBack, kStopping) and exits 0 within 5 s; after 10 s rollgaitd kills it.
// - End of standard input: rollgaitd has died. The agent claims nothing more, finishes what runs (events and leases go
//   on), then removes its lock file and exits. So kill -9 of rollgaitd loses no work and no agent stays behind.
// - Next start: the new agent binds agent.sock at once (the old name is replaced) and works beside an agent that is
//   still finishing; what that one runs counts against the new one's slots. Agents that all claim have N slots each. An
//   owner of LeaseOwners() whose lock file another can lock is dead: ReclaimOwner. With PostgreSQL an owner without a
//   lock file here lives elsewhere: its lease tells whether it is dead.
struct DataDir {
  std::string path;

  std::string Database() const { return path + "/rollgait.db"; }
  std::string ServerLock() const { return path + "/rollgaitd.lock"; }
  std::string AgentsDir() const { return path + "/agents"; }
  std::string AgentLock(const std::string& owner) const { return AgentsDir() + "/" + owner + ".lock"; }
  std::string AgentDraining(const std::string& owner) const { return AgentsDir() + "/" + owner + kDrainingSuffix; }

  std::string IteratesDir() const { return path + "/iterates"; }

  static constexpr char kDrainingSuffix[] = ".draining";
};

// Names of the notification sockets, relative to the data directory.
inline constexpr char kServerSocket[] = "rollgaitd.sock";
inline constexpr char kAgentSocket[] = "agent.sock";

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_DATA_DIR_H_
