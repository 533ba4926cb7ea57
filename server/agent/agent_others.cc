// What an agent does about the others of its store: those that died, those that drain.
#include <spdlog/common.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "server/agent/agent.h"
#include "server/base/logging.h"

namespace rollgait::server {
namespace {

constexpr std::chrono::milliseconds kReclaim{2000};  // between looks for solves of dead agents

}  // namespace

void Agent::StoreFailed(const char* wanted, const Error& error) {
  LogEvent(spdlog::level::warn, "store.failed", {{"wanted", wanted}, {"reason", error.message}});
}

void Agent::LookAfterOthers(SteadyTime now) {
  reclaim_at_ = now + kReclaim;
  ReclaimDeadOwners();
  const Outcome<std::vector<std::string>> expired = store_.ReclaimExpired();
  if (!expired.ok()) {
    StoreFailed("expired leases", expired.error());
    return;
  }
  for (const std::string& id : expired.value()) context_.poke(id);
  if (!expired.value().empty()) poked_ = true;
}

// Commits the ends that dead agents left in the spool.
void Agent::ReplayDead(const std::string& known_dead) {
  const DataDir directory{options_.work_dir};
  const auto is_dead = [&](const std::string& owner) {
    if (owner == owner_ || owner == known_dead) return owner == known_dead;
    Outcome<std::optional<FileLock>> lock = FileLock::TryAcquire(directory.AgentLock(owner));
    if (!lock.ok() || !lock.value()) return false;
    lock.value()->ReleaseAndRemove();
    return true;
  };
  for (const std::string& id : ReplaySpool(spool_, store_, is_dead)) context_.poke(id);
}

bool Agent::LivesElsewhere(const std::string& owner) const {
  return !options_.all_agents_here && access(DataDir{options_.work_dir}.AgentLock(owner).c_str(), F_OK) != 0;
}

void Agent::ReclaimDeadOwners() {
  const Outcome<std::vector<LeaseOwner>> owners = store_.LeaseOwners();
  if (!owners.ok()) {
    StoreFailed("dead agents", owners.error());
    return;
  }
  const DataDir directory{options_.work_dir};
  for (const auto& [owner, running] : owners.value()) {
    if (owner == owner_ || LivesElsewhere(owner)) continue;
    Outcome<std::optional<FileLock>> lock = FileLock::TryAcquire(directory.AgentLock(owner));
    if (!lock.ok() || !lock.value()) continue;  // it lives
    ReplayDead(owner);
    const Outcome<std::vector<std::string>> ids = store_.ReclaimOwner(owner);
    if (!ids.ok()) {
      StoreFailed("a dead agent's solves", ids.error());
      continue;
    }
    LogEvent(spdlog::level::info, "agent.found_dead", {{"owner", owner}, {"solves", ids.value().size()}});
    for (const std::string& id : ids.value()) {
      iterates_.Remove(id);
      context_.poke(id);
    }
    poked_ = true;
    unlink(directory.AgentDraining(owner).c_str());
    lock.value()->ReleaseAndRemove();
  }
}

// Solves that agents of this directory finish before they go.
int Agent::RunByDrainingAgents() {
  std::vector<std::string> draining;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(DataDir{options_.work_dir}.AgentsDir(), failure)) {
    if (entry.path().extension() == DataDir::kDrainingSuffix) draining.push_back(entry.path().stem().string());
  }
  if (draining.empty()) return 0;
  const Outcome<std::vector<LeaseOwner>> owners = store_.LeaseOwners();
  if (!owners.ok()) return 0;  // then nothing will be claimed either
  int count = 0;
  for (const auto& [owner, solves] : owners.value()) {
    if (std::find(draining.begin(), draining.end(), owner) != draining.end()) count += solves;
  }
  return count;
}

// Iterates of solves that ended or were deleted after their agent had died.
void Agent::RemoveOldIterates() {
  for (const std::string& id : iterates_.Owners()) {
    const Outcome<SolveRecord> record = store_.Get(id);
    const bool is_running =
        record.ok() ? record.value().state == SolveState::kRunning : record.error().code != ErrorCode::kNotFound;
    if (!is_running) iterates_.Remove(id);
  }
}

// Journals of solves that ended or were deleted while another agent had them.
void Agent::RemoveOldJournals() {
  for (const std::string& id : spool_.JournalOwners()) {
    const Outcome<SolveRecord> record = store_.Get(id);
    const bool is_over = record.ok() ? IsTerminal(record.value().state) : record.error().code == ErrorCode::kNotFound;
    if (is_over) spool_.RemoveJournals(id);
  }
}

}  // namespace rollgait::server
