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
  Query models(connection, "SELECT CAST(COALESCE(SUM(bytes), 0) AS BIGINT) FROM models WHERE tenant = ?", tenant);
  int64_t bytes = 0;
  for (Query* part : {&solves, &starts, &models}) bytes += part->Step() ? part->Int(0) : 0;
  return bytes;
}

}  // namespace

std::optional<Error> StorageUse::Refusal(SqlConnection& connection, const Claim& claim) {
  if (claim.limit <= 0) return std::nullopt;
  const std::string& tenant = claim.tenant;
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
  if (known.bytes + claim.bytes <= claim.limit) {
    known.bytes += claim.bytes;
    return std::nullopt;
  }
  const std::string text = "solves and models of tenant \"" + tenant + "\" take " + std::to_string(known.bytes) +
                           " bytes, this one would add " + std::to_string(claim.bytes) + " and the limit is " +
                           std::to_string(claim.limit);
  Error error{ErrorCode::kResourceExhausted,
              text + "; delete some that are not needed any more (DeleteSolve, DeleteModel)"};
  error.quota = {"tenant:" + tenant, text};
  return error;
}

void StorageUse::Forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_.clear();
}

}  // namespace rollgait::server
