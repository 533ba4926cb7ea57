#include "client/tradeoff/solve_row.h"

#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

const char* MinimumName(Minimum minimum) {
  switch (minimum) {
    case Minimum::kSame:
      return "same";
    case Minimum::kOther:
      return "other";
    default:
      return "unknown";
  }
}

std::string EndedAs(const SolveRow& row) {
  if (row.solve.state() != v1::SOLVE_STATE_SUCCEEDED) return StateName(row.solve.state());
  return TerminationName(row.solve.result().termination());
}

void AddErrors(const std::optional<TrueErrors>& errors, const std::string& prefix, json& cells) {
  if (!errors) return;
  cells[prefix + "objective_error"] = errors->objective;
  cells[prefix + "angle_error_deg"] = errors->angle_deg;
  cells[prefix + "torque_error_n_m"] = errors->torque_n_m;
}

json CellsOf(const SolveRow& row) {
  json cells = {{"scheme", row.point.scheme},
                {"intervals", row.point.intervals},
                {"tolerance", row.point.tolerance},
                {"solve", row.solve.name()},
                {"state", v1::SolveState_Name(row.solve.state())},
                {"ended", EndedAs(row)},
                {"from_cache", row.solve.from_cache()}};
  if (!row.solve.error().message().empty()) cells["error"] = row.solve.error().message();
  if (row.solve.has_result()) {
    cells["termination"] = v1::Termination_Name(row.solve.result().termination());
    cells["cpu_time_s"] = row.solve.result().cpu_time_s();
    cells["iterations"] = row.iterations;
    cells["objective"] = row.solve.result().objective();
  }
  if (row.errors) {
    cells["minimum"] = MinimumName(row.minimum);
    cells["well_known"] = row.is_well_known;
  }
  AddErrors(row.errors, "", cells);
  AddErrors(row.estimated, "estimated_", cells);
  return cells;
}

}  // namespace

SolveRow RowOfPoint(const TradeoffPoint& point, const v1::Solve& solve) {
  SolveRow row;
  row.point = point;
  row.solve = solve;
  row.solve.mutable_result()->clear_trajectory();
  row.solve.mutable_result()->clear_multipliers();
  if (!solve.has_result()) row.solve.clear_result();
  row.is_optimal = solve.state() == v1::SOLVE_STATE_SUCCEEDED && solve.result().has_trajectory() &&
                   solve.result().termination() == v1::TERMINATION_OPTIMAL;
  for (const v1::MeshStatistics& mesh : solve.result().meshes()) row.iterations += mesh.iterations();
  return row;
}

std::optional<TrueErrors> EstimateOf(const v1::SolveResult& result) {
  if (!result.has_errors()) return std::nullopt;
  TrueErrors estimate{result.errors().objective(), 0, 0};
  for (const v1::QuantityError& quantity : result.errors().quantities()) {
    if (quantity.quantity() == "joint angle") estimate.angle_deg = quantity.largest() * 180 / kPi;
    if (quantity.quantity() == "joint torque") estimate.torque_n_m = quantity.largest();
  }
  return estimate;
}

TradeoffTable SolveTable(const std::string& name, const std::string& reference, const std::vector<SolveRow>& rows) {
  TradeoffTable table;
  table.name = name;
  table.reference = reference;
  table.error = "angle_error_deg";
  table.same = "minimum";
  table.series = "scheme";
  table.columns = {{"scheme", "scheme"},
                   {"intervals", "intervals"},
                   {"tolerance", "tolerance"},
                   {"solve", ""},
                   {"ended", "ended"},
                   {"from_cache", ""},
                   {"minimum", "minimum"},
                   {"well_known", ""},
                   {"on_front", ""},
                   {"cpu_time_s", "CPU s"},
                   {"iterations", "iterations", 1, 6},
                   {"objective", "objective", 1, 7},
                   {"objective_error", "error %", 100, 4, "Error of the objective", ""},
                   {"angle_error_deg", "angle °", 1, 4, "Largest error of a joint angle", "°"},
                   {"torque_error_n_m", "torque N m", 1, 4, "Largest error of a joint torque", "N m"},
                   {"estimated_objective_error", "estimated: %", 100, 4},
                   {"estimated_angle_error_deg", "angle °"},
                   {"estimated_torque_error_n_m", "torque N m"}};
  for (const SolveRow& row : rows) AddRow(table, CellsOf(row));
  MarkFront(table);
  return table;
}

}  // namespace rollgait::client
