#ifndef ROLLGAIT_SERVER_STORE_SOLVE_PLACE_H_
#define ROLLGAIT_SERVER_STORE_SOLVE_PLACE_H_

#include <cstdint>
#include <optional>
#include <string>

namespace rollgait::server {

// Where a request stands among those that differ from it in slope and speed only, so that the nearest solution is found
// through an index: specs, which may have megabytes, are not read.
struct SolvePlace {
  std::string question;  // digest of what they have in common; empty: stands nowhere
  double slope_rad = 0;
  double speed_m_s = 0;  // prescribed; 0 among those that prescribe none
};

// Asks for the solve with an optimal result that stands nearest, the youngest of several.
struct NearQuery {
  SolvePlace place;
  std::optional<std::string> tenant;  // nullopt: of any
  // Distances are counted in these units, both > 0, and added as squares; none farther than `farthest` is found.
  double slope_unit_rad = 1, speed_unit_m_s = 1, farthest = 0;
};

// A solve that was stored before there were places.
struct UnplacedSolve {
  int64_t number = 0;
  std::string spec;  // v1::SolveSpec
};

struct PlacedSolve {
  int64_t number = 0;
  SolvePlace place;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SOLVE_PLACE_H_
