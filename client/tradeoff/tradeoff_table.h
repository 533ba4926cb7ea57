// What `rollgait tradeoff` found, one row a point.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_TRADEOFF_TABLE_H_
#define ROLLGAIT_CLIENT_TRADEOFF_TRADEOFF_TABLE_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/tradeoff/minimum.h"
#include "client/tradeoff/points.h"
#include "client/tradeoff/true_errors.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct TradeoffRow {
  TradeoffPoint point;
  v1::Solve solve;  // without trajectory and multipliers
  bool is_optimal = false;
  int iterations = 0;
  std::optional<TrueErrors> errors;     // none without a reference
  std::optional<TrueErrors> estimated;  // by the service, with --errors
  Minimum minimum = Minimum::kUnknown;
  bool is_well_known = false;  // the error of the angle
  bool is_on_front = false;
};

// Without errors.
TradeoffRow RowOfPoint(const TradeoffPoint& point, const v1::Solve& solve);
// The largest errors that the service estimated; none where it gave no estimate.
std::optional<TrueErrors> EstimateOf(const v1::SolveResult& result);

// Marks the optimal rows in the reference's minimum of which no other is as fast and as accurate, and better in one:
// CPU time against the largest error of a joint angle.
void MarkFront(std::vector<TradeoffRow>& rows);

// For people; comma separated values with a line of names (RFC 4180); {"tradeoff", "reference", "points"}. `reference`
// is the name of the solve, empty: none.
std::string TradeoffText(const std::vector<TradeoffRow>& rows);
std::string TradeoffCsv(const std::vector<TradeoffRow>& rows);
nlohmann::json TradeoffJson(const std::string& name, const std::string& reference,
                            const std::vector<TradeoffRow>& rows);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_TRADEOFF_TABLE_H_
