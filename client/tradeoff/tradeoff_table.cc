#include "client/tradeoff/tradeoff_table.h"

#include <algorithm>

#include "client/formats/exact_number.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

std::string MinimumName(const TradeoffRow& row) {
  if (!row.errors) return "";
  switch (row.minimum) {
    case Minimum::kSame:
      return "same";
    case Minimum::kOther:
      return "other";
    default:
      return "unknown";
  }
}

std::string EndedAs(const TradeoffRow& row) {
  if (row.solve.state() != v1::SOLVE_STATE_SUCCEEDED) return StateName(row.solve.state());
  return TerminationName(row.solve.result().termination());
}

// The columns after scheme, intervals, tolerance and the words; null where a value is not known.
std::vector<std::pair<std::string, json>> ValuesOf(const TradeoffRow& row) {
  const v1::SolveResult& result = row.solve.result();
  const bool has_result = row.solve.has_result();
  const auto error = [](const std::optional<TrueErrors>& errors, double TrueErrors::*value) {
    return errors ? json((*errors).*value) : json();
  };
  return {{"cpu_time_s", has_result ? json(result.cpu_time_s()) : json()},
          {"iterations", has_result ? json(row.iterations) : json()},
          {"objective", has_result ? json(result.objective()) : json()},
          {"objective_error", error(row.errors, &TrueErrors::objective)},
          {"angle_error_deg", error(row.errors, &TrueErrors::angle_deg)},
          {"torque_error_n_m", error(row.errors, &TrueErrors::torque_n_m)},
          {"estimated_objective_error", error(row.estimated, &TrueErrors::objective)},
          {"estimated_angle_error_deg", error(row.estimated, &TrueErrors::angle_deg)},
          {"estimated_torque_error_n_m", error(row.estimated, &TrueErrors::torque_n_m)}};
}

}  // namespace

TradeoffRow RowOfPoint(const TradeoffPoint& point, const v1::Solve& solve) {
  TradeoffRow row;
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

void MarkFront(std::vector<TradeoffRow>& rows) {
  const auto may_be = [](const TradeoffRow& row) {
    return row.is_optimal && row.errors && row.minimum == Minimum::kSame;
  };
  for (TradeoffRow& row : rows) {
    const auto beats = [&](const TradeoffRow& other) {
      const double time = row.solve.result().cpu_time_s(), others_time = other.solve.result().cpu_time_s();
      return may_be(other) && others_time <= time && other.errors->angle_deg <= row.errors->angle_deg &&
             (others_time < time || other.errors->angle_deg < row.errors->angle_deg);
    };
    row.is_on_front = may_be(row) && std::none_of(rows.begin(), rows.end(), beats);
  }
}

std::string TradeoffText(const std::vector<TradeoffRow>& rows) {
  std::vector<std::vector<std::string>> cells = {{"front", "scheme", "intervals", "tolerance", "ended", "minimum",
                                                  "CPU s", "iterations", "objective", "error %", "angle °",
                                                  "torque N m", "estimated: %", "angle °", "torque N m"}};
  for (const TradeoffRow& row : rows) {
    std::vector<std::string> line = {
        row.is_on_front ? "*" : "",        row.point.scheme, std::to_string(row.point.intervals),
        FormatNumber(row.point.tolerance), EndedAs(row),     row.errors ? MinimumName(row) : "-"};
    for (const auto& [name, value] : ValuesOf(row)) {
      const double scale = name.find("objective_error") != std::string::npos ? 100 : 1;
      const int digits = name == "objective" ? 7 : 4;
      const std::string mark = name == "angle_error_deg" && row.errors && !row.is_well_known ? "?" : "";
      line.push_back(value.is_null() ? "-" : mark + FormatNumber(scale * value.get<double>(), digits));
    }
    cells.push_back(std::move(line));
  }
  return FormatTable(cells, "llrrllrrrrrrrrr");
}

std::string TradeoffCsv(const std::vector<TradeoffRow>& rows) {
  std::string text = "scheme,intervals,tolerance,solve,ended,from_cache,minimum,well_known,on_front";
  for (const auto& [name, value] : ValuesOf(TradeoffRow())) text += "," + name;
  text += "\n";
  for (const TradeoffRow& row : rows) {
    text += row.point.scheme + "," + std::to_string(row.point.intervals) + "," + Exact(row.point.tolerance) + "," +
            row.solve.name() + "," + EndedAs(row) + "," + (row.solve.from_cache() ? "1," : "0,") + MinimumName(row) +
            (row.is_well_known ? ",1" : ",0") + (row.is_on_front ? ",1" : ",0");
    for (const auto& [name, value] : ValuesOf(row)) text += "," + (value.is_null() ? "" : Exact(value.get<double>()));
    text += "\n";
  }
  return text;
}

json TradeoffJson(const std::string& name, const std::string& reference, const std::vector<TradeoffRow>& rows) {
  json points = json::array();
  for (const TradeoffRow& row : rows) {
    json point = {{"scheme", row.point.scheme},
                  {"intervals", row.point.intervals},
                  {"tolerance", row.point.tolerance},
                  {"solve", row.solve.name()},
                  {"state", v1::SolveState_Name(row.solve.state())},
                  {"from_cache", row.solve.from_cache()},
                  {"on_front", row.is_on_front}};
    if (row.solve.has_result()) point["termination"] = v1::Termination_Name(row.solve.result().termination());
    if (!row.solve.error().message().empty()) point["error"] = row.solve.error().message();
    if (row.errors) {
      point["minimum"] = MinimumName(row);
      point["well_known"] = row.is_well_known;
    }
    for (const auto& [column, value] : ValuesOf(row)) {
      if (!value.is_null()) point[column] = value;
    }
    points.push_back(std::move(point));
  }
  json data = {{"tradeoff", name}, {"points", std::move(points)}};
  if (!reference.empty()) data["reference"] = reference;
  return data;
}

}  // namespace rollgait::client
