// What a sweep found, one row a point.
#ifndef ROLLGAIT_CLIENT_SWEEP_SWEEP_TABLE_H_
#define ROLLGAIT_CLIENT_SWEEP_SWEEP_TABLE_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/failure.h"
#include "client/sweep/grid.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// A finished solve without what is long in it.
struct SweepRow {
  std::string solve;  // its name
  v1::SolveState state = v1::SOLVE_STATE_UNSPECIFIED;
  v1::SolveOutcome outcome;
  bool has_trajectory = false;  // of the result; the numbers below are 0 without
  double objective = 0, speed_m_s = 0, step_length_m = 0, cpu_time_s = 0;
  std::string error;  // of a run without an answer
  ExitCode code = ExitCode::kSuccess;
};
SweepRow RowOf(const v1::Solve& solve);

// Rows belong to the points of the grid. For people; comma separated values with a line of names (RFC 4180); one
// object: {"sweep": its name, "points": [...]}. Names of columns have their units.
std::string SweepText(const SweepGrid& grid, const std::vector<SweepRow>& rows);
std::string SweepCsv(const SweepGrid& grid, const std::vector<SweepRow>& rows);
nlohmann::json SweepJson(const std::string& sweep, const SweepGrid& grid, const std::vector<SweepRow>& rows);

// "optimal, within", or the state of one without an answer and why.
std::string EndOf(const SweepRow& row);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_SWEEP_TABLE_H_
