#ifndef ROLLGAIT_SERVER_AGENT_SPOOL_H_
#define ROLLGAIT_SERVER_AGENT_SPOOL_H_

#include <functional>
#include <string>
#include <vector>

#include "server/base/outcome.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// An end that waits for its commit.
struct PendingEnd {
  Lease lease;
  std::vector<StoredEvent> events;
  SolveEnd end;
};

// Ends of solves on disk, one file each, from before the commit in the store until after it: an agent that dies in
// between loses no finished result. One thread; several agents may use one directory.
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

 private:
  explicit Spool(std::string directory) : directory_(std::move(directory)) {}
  std::string Path(const Lease& lease) const;
  std::string directory_;
};

// Commits what the spool holds of dead owners. What the store refuses for good (the lease is lost: it has the end
// already, or another run has the solve) is removed; what it cannot take now stays. Returns the ids of the solves that
// were committed.
std::vector<std::string> ReplaySpool(const Spool& spool, SolveStore& store,
                                     const std::function<bool(const std::string& owner)>& is_dead);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_SPOOL_H_
