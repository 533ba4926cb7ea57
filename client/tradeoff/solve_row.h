// The rows of solves in a trade-off.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_SOLVE_ROW_H_
#define ROLLGAIT_CLIENT_TRADEOFF_SOLVE_ROW_H_

#include <optional>
#include <string>
#include <vector>

#include "client/tradeoff/minimum.h"
#include "client/tradeoff/points.h"
#include "client/tradeoff/tradeoff_table.h"
#include "client/tradeoff/true_errors.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct SolveRow {
  TradeoffPoint point;
  v1::Solve solve;  // without trajectory and multipliers
  bool is_optimal = false;
  int iterations = 0;
  std::optional<TrueErrors> errors;     // none without a reference, or of a solve that is not optimal
  std::optional<TrueErrors> estimated;  // by the service, with --errors
  Minimum minimum = Minimum::kUnknown;
  bool is_well_known = false;  // the error of the angle
};

// Without errors.
SolveRow RowOfPoint(const TradeoffPoint& point, const v1::Solve& solve);
// The largest errors that the service estimated; none where it gave no estimate.
std::optional<TrueErrors> EstimateOf(const v1::SolveResult& result);

// With its front: CPU time against the largest error of a joint angle. `reference` is the name of the solve, empty:
// none.
TradeoffTable SolveTable(const std::string& name, const std::string& reference, const std::vector<SolveRow>& rows);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_SOLVE_ROW_H_
