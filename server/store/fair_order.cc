#include "server/store/fair_order.h"

#include <algorithm>

namespace rollgait::server {

Share ReadShare(const Query& query, int first_column) {
  return {query.Int(first_column), query.Int(first_column + 1),
          std::clamp<int64_t>(query.Int(first_column + 2), 1, kMostWeight), query.Int(first_column + 3) != 0};
}

void CountClaim(SqlConnection& connection, const std::string& tenant, const Share& share) {
  if (share.alone) return;
  const int64_t start = std::max(share.finish_tag, share.virtual_time);
  // Others may have counted claims of the same tenant meanwhile: the finish tag comes after theirs. The start tag is
  // what the choice was made by, so that virtual time does not pass those who waited while several agents chose the
  // same tenant.
  Query::Do(connection,
            "INSERT INTO shares (tenant, start_tag, finish_tag) VALUES (?, ?, ?) ON CONFLICT (tenant) DO UPDATE SET "
            "start_tag = CASE WHEN shares.start_tag > excluded.start_tag THEN shares.start_tag ELSE "
            "excluded.start_tag END, finish_tag = excluded.finish_tag - excluded.start_tag + CASE WHEN "
            "shares.finish_tag > excluded.start_tag THEN shares.finish_tag ELSE excluded.start_tag END",
            tenant, start, start + kClaimCost / share.weight);
}

}  // namespace rollgait::server
