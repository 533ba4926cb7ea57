#include "client/tradeoff/scene_row.h"

#include <algorithm>
#include <cctype>

#include "client/tradeoff/minimum.h"

namespace rollgait::client {

using nlohmann::json;

std::string EndWord(v1::SimulationReport::End end) {
  std::string word = v1::SimulationReport::End_Name(end);
  if (word.rfind("END_", 0) == 0) word.erase(0, 4);
  std::replace(word.begin(), word.end(), '_', ' ');
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

json SceneRow(const ScenePoint& point, const v1::SimulationReport& report, double cpu_time_s,
              const std::optional<SceneErrors>& errors, double reference_difference) {
  json cells = {{"tolerance", point.tolerance},
                {"absolute_tolerance", point.absolute.value_or(point.tolerance)},
                {"drift", DriftWord(point.drift)},
                {"ended", EndWord(report.end())},
                {"cpu_time_s", cpu_time_s},
                {"steps", report.steps()},
                {"evaluations", report.evaluations()},
                {"reported_energy_error_j", report.max_energy_error_j()},
                {"reported_gap_m", report.max_gap_m()},
                {"reported_slip_m_s", report.max_slip_m_s()}};
  if (!errors) return cells;
  cells["motion"] = errors->same_motion ? "same" : "other";
  cells["well_known"] = IsWellKnown(errors->pose(), reference_difference);
  cells["pose_error"] = errors->pose();
  cells["position_error_m"] = errors->position_m;
  cells["angle_error_deg"] = errors->angle_deg;
  cells["velocity_error_m_s"] = errors->velocity_m_s;
  cells["angular_velocity_error_deg_s"] = errors->angular_velocity_deg_s;
  if (errors->event_time_s) cells["event_time_error_s"] = *errors->event_time_s;
  return cells;
}

TradeoffTable SceneTable(const std::string& name, const std::string& reference) {
  TradeoffTable table;
  table.name = name;
  table.reference = reference;
  table.error = "pose_error";
  table.same = "motion";
  table.series = "drift";
  table.columns = {{"tolerance", "tolerance"},
                   {"absolute_tolerance", "absolute"},
                   {"drift", "drift"},
                   {"ended", "ended"},
                   {"motion", "motion"},
                   {"well_known", ""},
                   {"on_front", ""},
                   {"cpu_time_s", "CPU s"},
                   {"steps", "steps", 1, 9},
                   {"evaluations", "evaluations", 1, 9},
                   {"pose_error", "m or rad", 1, 3, "Largest error of a position or angle", "m or rad"},
                   {"position_error_m", "position m", 1, 3, "Largest error of a position", "m"},
                   {"angle_error_deg", "angle °", 1, 3, "Largest error of an angle", "°"},
                   {"velocity_error_m_s", "m/s", 1, 3},
                   {"angular_velocity_error_deg_s", "°/s", 1, 3},
                   {"event_time_error_s", "event s", 1, 3},
                   {"reported_energy_error_j", "reported: energy J", 1, 3},
                   {"reported_gap_m", "gap m", 1, 3},
                   {"reported_slip_m_s", "slip m/s", 1, 3}};
  return table;
}

}  // namespace rollgait::client
