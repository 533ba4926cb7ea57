#ifndef ROLLGAIT_SERVER_STORE_FAIR_ORDER_H_
#define ROLLGAIT_SERVER_STORE_FAIR_ORDER_H_

#include <cstdint>
#include <string>

#include "server/store/sql_connection.h"

namespace rollgait::server {

// Whose turn it is: start-time fair queueing (Goyal, Vin, Cheng 1996) over the tenants that have queued solves. Each
// claim is a unit of work. It has a start tag, the later of the virtual time and of the tenant's last finish tag, and a
// finish tag, which is kClaimCost / weight later. The tenant with the least start tag is next; virtual time is the
// largest start tag that a tenant was chosen by. So who was away has no more credit than who comes new, and while a
// tenant of weight v waits one of weight w gets at most w / v + 1 claims, and as many more as others make at the same
// time (PostgreSQL): agents that choose at the same time choose the same tenant by the same tag. Their claims move its
// finish tag one after the other, and virtual time not at all, so that the others catch up.
inline constexpr int64_t kClaimCost = 1'000'000;
inline constexpr int kMostWeight = 100;

// The tenants that have queued solves and room to run one, the next first. Goes from tenant to tenant along the index
// solves_queued, whatever the length of the queue.
#define ROLLGAIT_TENANTS_BY_TURN                                                                                       \
  "WITH RECURSIVE waiting(tenant) AS (SELECT (SELECT MIN(q.tenant) FROM solves AS q {along_queue} WHERE q.state = 1) " \
  "UNION ALL SELECT (SELECT MIN(q.tenant) FROM solves AS q {along_queue} WHERE q.state = 1 AND q.tenant > w.tenant) "  \
  "FROM waiting AS w WHERE w.tenant IS NOT NULL), now_is(tag) AS (SELECT COALESCE(MAX(start_tag), 0) FROM "            \
  "shares) SELECT w.tenant FROM waiting AS w CROSS JOIN now_is LEFT JOIN tenants AS t ON t.tenant = "                  \
  "w.tenant LEFT JOIN shares AS h ON h.tenant = w.tenant WHERE w.tenant IS NOT NULL AND "                              \
  "(COALESCE(t.max_running, -1) < 0 OR t.max_running > (SELECT COUNT(*) FROM solves AS b WHERE b.tenant = "            \
  "w.tenant AND b.state = 2)) "                                                                                        \
  "ORDER BY CASE WHEN h.finish_tag > now_is.tag THEN h.finish_tag ELSE now_is.tag END, w.tenant "

// Of the tenant of a solve `s`, in the order of Share.
#define ROLLGAIT_SHARE_COLUMNS                                                           \
  "COALESCE((SELECT h.finish_tag FROM shares AS h WHERE h.tenant = s.tenant), 0), "      \
  "COALESCE((SELECT MAX(h.start_tag) FROM shares AS h), 0), "                            \
  "COALESCE((SELECT t.weight FROM tenants AS t WHERE t.tenant = s.tenant), 1), "         \
  "CASE WHEN (SELECT MIN(q.tenant) FROM solves AS q {along_queue} WHERE q.state = 1) = " \
  "(SELECT MAX(q.tenant) FROM solves AS q {along_queue} WHERE q.state = 1) THEN 1 ELSE 0 END "
inline constexpr int kShareColumns = 4;

struct Share {
  int64_t finish_tag = 0, virtual_time = 0, weight = 1;
  bool alone = false;  // no other tenant has queued solves
};
Share ReadShare(const Query& query, int first_column);

// Counts a claim of the tenant. Where nobody else waits there is nothing to share, and nothing is written.
void CountClaim(SqlConnection& connection, const std::string& tenant, const Share& share);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_FAIR_ORDER_H_
