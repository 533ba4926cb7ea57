// SqlStore: the index that `nearest` looks into.
#include <cmath>

#include "rollgait/v1/solve.pb.h"
#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

// Squares of the distances, which lie within a rectangle that the index finds.
#define ROLLGAIT_NEAREST_FIRST                                                                               \
  "AND optimal = 1 AND slope_rad BETWEEN ? AND ? AND speed_m_s BETWEEN ? AND ? ORDER BY "                    \
  "(slope_rad - ?) * (slope_rad - ?) * ? + (speed_m_s - ?) * (speed_m_s - ?) * ?, solve DESC LIMIT 1) AS p " \
  "JOIN solves ON number = p.solve"
#define ROLLGAIT_PLACES "SELECT id, p.slope_rad, p.speed_m_s FROM (SELECT solve, slope_rad, speed_m_s FROM places "

Query Ask(SqlConnection& connection, const NearQuery& near) {
  const double slope = near.place.slope_rad, speed = near.place.speed_m_s;
  const double slope_reach = near.farthest * near.slope_unit_rad, speed_reach = near.farthest * near.speed_unit_m_s;
  const double slope_scale = 1 / (near.slope_unit_rad * near.slope_unit_rad);
  const double speed_scale = 1 / (near.speed_unit_m_s * near.speed_unit_m_s);
  if (near.tenant.has_value()) {
    return Query(connection, ROLLGAIT_PLACES "WHERE question = ? AND tenant = ? " ROLLGAIT_NEAREST_FIRST,
                 near.place.question, *near.tenant, slope - slope_reach, slope + slope_reach, speed - speed_reach,
                 speed + speed_reach, slope, slope, slope_scale, speed, speed, speed_scale);
  }
  return Query(connection, ROLLGAIT_PLACES "WHERE question = ? " ROLLGAIT_NEAREST_FIRST, near.place.question,
               slope - slope_reach, slope + slope_reach, speed - speed_reach, speed + speed_reach, slope, slope,
               slope_scale, speed, speed, speed_scale);
}

}  // namespace

Outcome<std::string> SqlStore::Nearest(const NearQuery& query) {
  if (query.place.question.empty()) return std::string();
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<std::string> {
    Query row = Ask(connection, query);
    if (!row.Step()) return std::string();
    const double distance = std::hypot((row.Double(1) - query.place.slope_rad) / query.slope_unit_rad,
                                       (row.Double(2) - query.place.speed_m_s) / query.speed_unit_m_s);
    return distance <= query.farthest ? row.Bytes(0) : std::string();
  });
}

Outcome<std::vector<UnplacedSolve>> SqlStore::Unplaced(int64_t after_number, int most) {
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<std::vector<UnplacedSolve>> {
    std::vector<UnplacedSolve> solves;
    Query query(connection,
                "SELECT number, spec FROM solves WHERE number > ? AND NOT EXISTS (SELECT 1 FROM places WHERE "
                "places.solve = solves.number) ORDER BY number LIMIT ?",
                after_number, most);
    while (query.Step()) solves.push_back({query.Int(0), query.Bytes(1)});
    return solves;
  });
}

Outcome<Done> SqlStore::SetPlaces(const std::vector<PlacedSolve>& solves) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<Done> {
    for (const PlacedSolve& solve : solves) {
      // One that was deleted meanwhile, or placed by another server, stays as it is.
      Query::Do(connection,
                "INSERT INTO places (solve, tenant, question, slope_rad, speed_m_s, optimal) SELECT number, tenant, ?, "
                "?, ?, CASE WHEN EXISTS (SELECT 1 FROM results WHERE results.id = result_id AND termination = ?) THEN "
                "1 ELSE 0 END FROM solves WHERE number = ? ON CONFLICT (solve) DO NOTHING",
                solve.place.question, solve.place.slope_rad, solve.place.speed_m_s,
                static_cast<int>(v1::TERMINATION_OPTIMAL), solve.number);
    }
    return Done{};
  });
}

}  // namespace rollgait::server
