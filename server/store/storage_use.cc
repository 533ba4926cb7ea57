#include "server/store/storage_use.h"

#include <algorithm>

namespace rollgait::server {
namespace {

constexpr std::chrono::seconds kGoodFor{2};
constexpr int kMostOfTheTime = 20;       // sums take at most a twentieth of it
constexpr size_t kMostTenants = 10'000;  // whose sums are remembered

int64_t Sum(SqlConnection& connection, const std::string& tenant) {
  Query solves(connection, "SELECT CAST(COALESCE(SUM(bytes), 0) AS BIGINT) FROM solves WHERE tenant = ?", tenant);
  Query starts(connection,
               "SELECT CAST(COALESCE(SUM(LENGTH(payload)), 0) AS BIGINT) FROM warm_starts, solves WHERE solve = number "
               "AND tenant = ? AND state IN (1, 2)",
               tenant);
  const int64_t bytes = solves.Step() ? solves.Int(0) : 0;
  return bytes + (starts.Step() ? starts.Int(0) : 0);
}

}  // namespace

std::optional<Error> StorageUse::Refusal(SqlConnection& connection, const NewSolve& solve) {
  if (solve.max_bytes_tenant <= 0) return std::nullopt;
  const std::string& tenant = solve.actor.tenant;
  const auto more = static_cast<int64_t>(solve.spec.size() + solve.warm_start.size());
  const std::lock_guard<std::mutex> lock(mutex_);
  if (known_.size() >= kMostTenants) known_.clear();
  Known& known = known_[tenant];
  const Clock::time_point start = Clock::now();
  if (start >= known.good_until) {
    known.good_until = {};  // should it fail
    known.bytes = Sum(connection, tenant);
    const Clock::time_point end = Clock::now();
    known.good_until = end + std::max<Clock::duration>(kGoodFor, kMostOfTheTime * (end - start));
  }
  if (known.bytes + more <= solve.max_bytes_tenant) {
    known.bytes += more;
    return std::nullopt;
  }
  const std::string text = "solves of tenant \"" + tenant + "\" take " + std::to_string(known.bytes) +
                           " bytes, this one would add " + std::to_string(more) + " and the limit is " +
                           std::to_string(solve.max_bytes_tenant);
  Error error{ErrorCode::kResourceExhausted, text + "; delete some that are not needed any more (DeleteSolve)"};
  error.quota = {"tenant:" + tenant, text};
  return error;
}

void StorageUse::Forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_.clear();
}

}  // namespace rollgait::server
