// The points of `rollgait tradeoff`: one request with several schemes, meshes and tolerances.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_POINTS_H_
#define ROLLGAIT_CLIENT_TRADEOFF_POINTS_H_

#include <string>
#include <vector>

#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::client {

struct TradeoffPoint {
  std::string scheme;  // a word of --scheme
  int intervals;       // of a single-support phase
  double tolerance;    // of the scaled KKT error
};

// The reference has four times the intervals of a point, and a request at most 1000.
inline constexpr int kMostIntervals = 250;
inline constexpr size_t kMostTradeoffPoints = 200;

// All combinations, the last axis changes fastest: "radau2,radau3", and what ParseSweepValues reads. Throws
// Failure(kUsage), which names flag, value and limit.
std::vector<TradeoffPoint> MakeTradeoffPoints(const std::string& schemes, const std::string& intervals,
                                              const std::string& tolerances);

// The request on exactly this mesh: without refinement and without an estimate of the errors. Throws Failure(kUsage) if
// it is a manoeuvre or names its own phases or a warm start.
v1::SolveSpec SpecOfPoint(v1::SolveSpec task, const TradeoffPoint& point);

// Order of the scheme at the end of an interval. Throws Failure(kUsage) for a scheme without a row in the table.
int OrderOf(const std::string& scheme);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_POINTS_H_
