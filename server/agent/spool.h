#ifndef ROLLGAIT_SERVER_AGENT_SPOOL_H_
#define ROLLGAIT_SERVER_AGENT_SPOOL_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/base/outcome.h"
#include "server/base/wire.pb.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// An end that waits for its commit.
struct PendingEnd {
  Lease lease;
  std::vector<StoredEvent> events;
  SolveEnd end;
};

// What an attempt has left of a solve that goes on.
struct KeptJournal {
  int64_t epoch = 0;  // of its lease
  wire::SpooledJournal content;
};

// Ends of solves on disk, one file each, from before the commit in the store until after it: an agent that dies in
// between loses no finished result. And journals of running solves, one file an attempt, from which the next attempt
// goes on. One thread; several agents may use one directory.
class Spool {
 public:
  // Makes the directory if need be. kUnavailable with the reason.
  static Outcome<Spool> Open(const std::string& directory);

  // Durable when it returns.
  Outcome<Done> Put(const PendingEnd& pending) const;
  void Remove(const Lease& lease) const;
  // Everything that is there. Files that cannot be read are renamed to *.bad and left; what an agent was writing when
  // it died is removed.
  std::vector<PendingEnd> ReadAll() const;

  // There for every process when it returns, whole or not at all; a machine that loses its power may lose it. Takes the
  // place of all journals of the solve with a smaller epoch.
  Outcome<Done> PutJournal(const Lease& lease, const wire::SpooledJournal& journal) const;
  // The one with the largest epoch that can be read. Those that cannot are removed, with a line in the log.
  std::optional<KeptJournal> NewestJournal(const std::string& solve_id) const;
  void RemoveJournals(const std::string& solve_id) const;
  // Solves that have one.
  std::vector<std::string> JournalOwners() const;

 private:
  explicit Spool(std::string directory) : directory_(std::move(directory)) {}
  std::string Path(const Lease& lease, const char* suffix) const;
  Outcome<Done> Write(const std::string& path, const std::string& payload, bool durable) const;
  struct JournalFile {
    std::string path, solve_id;
    int64_t epoch = 0;
  };
  std::vector<JournalFile> JournalFiles() const;
  std::string directory_;
};

// Commits what the spool holds of dead owners. What the store refuses for good (the lease is lost: it has the end
// already, or another run has the solve) is removed; what it cannot take now stays. Returns the ids of the solves that
// were committed.
std::vector<std::string> ReplaySpool(const Spool& spool, SolveStore& store,
                                     const std::function<bool(const std::string& owner)>& is_dead);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_SPOOL_H_
