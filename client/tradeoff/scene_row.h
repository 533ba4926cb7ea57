// The rows of simulations in a trade-off.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_SCENE_ROW_H_
#define ROLLGAIT_CLIENT_TRADEOFF_SCENE_ROW_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "client/tradeoff/scene_errors.h"
#include "client/tradeoff/scene_points.h"
#include "client/tradeoff/tradeoff_table.h"

namespace rollgait::client {

// Cells of a TradeoffTable that SceneTable makes. `errors` are none of a simulation that ended early.
//   cpu_time_s            the median of the runs of this point
//   reference_difference  pose() of the reference against one that is half an order coarser, m or rad
nlohmann::json SceneRow(const ScenePoint& point, const v1::SimulationReport& report, double cpu_time_s,
                        const std::optional<SceneErrors>& errors, double reference_difference);

// Without rows: CPU time against the pose's error.
TradeoffTable SceneTable(const std::string& name, const std::string& reference);

// "duration", "too many steps" …
std::string EndWord(v1::SimulationReport::End end);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_SCENE_ROW_H_
