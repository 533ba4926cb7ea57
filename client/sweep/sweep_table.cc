#include "client/sweep/sweep_table.h"

#include "client/formats/exact_number.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

struct Quantity {
  const char* column;
  double SweepRow::*value;
};
constexpr Quantity kQuantities[] = {{"objective", &SweepRow::objective},
                                    {"found_speed_m_s", &SweepRow::speed_m_s},
                                    {"found_step_length_m", &SweepRow::step_length_m},
                                    {"cpu_time_s", &SweepRow::cpu_time_s}};

std::string Ended(const SweepRow& row) {
  return row.outcome.termination() == v1::TERMINATION_UNSPECIFIED ? "" : TerminationName(row.outcome.termination());
}
std::string Judged(const SweepRow& row) {
  return row.state == v1::SOLVE_STATE_SUCCEEDED ? VerdictName(row.outcome.verdict()) : "";
}

std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

}  // namespace

SweepRow RowOf(const v1::Solve& solve) {
  SweepRow row;
  row.solve = solve.name();
  row.state = solve.state();
  row.outcome = solve.outcome();
  row.error = solve.error().message();
  row.code = ExitCodeOf(solve);
  row.has_trajectory = solve.result().has_trajectory();
  if (!row.has_trajectory) return row;
  row.objective = solve.result().objective();
  row.speed_m_s = solve.result().speed_m_s();
  row.step_length_m = solve.result().step_length_m();
  row.cpu_time_s = solve.result().cpu_time_s();
  return row;
}

std::string EndOf(const SweepRow& row) {
  if (row.state != v1::SOLVE_STATE_SUCCEEDED) return StateName(row.state) + (row.error.empty() ? "" : ": " + row.error);
  return Ended(row) + ", " + Judged(row);
}

std::string SweepText(const SweepGrid& grid, const std::vector<SweepRow>& rows) {
  std::vector<std::vector<std::string>> cells(1);
  std::string alignment;
  for (const SweepAxis& axis : grid.axes) {
    cells[0].push_back(axis.column);
    alignment += 'r';
  }
  for (const char* column : {"solve", "ended", "accuracy"}) cells[0].push_back(column);
  alignment += "lll";
  for (const Quantity& quantity : kQuantities) {
    cells[0].push_back(quantity.column);
    alignment += 'r';
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> line;
    for (const double value : grid.points[i].values) line.push_back(FormatNumber(value, 12));
    const SweepRow& row = rows[i];
    line.insert(line.end(), {row.solve, Ended(row).empty() ? StateName(row.state) : Ended(row),
                             Judged(row).empty() ? "-" : Judged(row)});
    for (const Quantity& quantity : kQuantities) {
      line.push_back(row.has_trajectory ? FormatNumber(row.*quantity.value) : "-");
    }
    cells.push_back(std::move(line));
  }
  return FormatTable(cells, alignment);
}

std::string SweepCsv(const SweepGrid& grid, const std::vector<SweepRow>& rows) {
  std::string text;
  for (const SweepAxis& axis : grid.axes) text += axis.column + ",";
  text += "solve,state,termination,verdict";
  for (const Quantity& quantity : kQuantities) text += std::string(",") + quantity.column;
  text += ",error\n";
  for (size_t i = 0; i < rows.size(); ++i) {
    const SweepRow& row = rows[i];
    for (const double value : grid.points[i].values) text += Exact(value) + ",";
    text += row.solve + "," + StateName(row.state) + "," + Ended(row) + "," + Judged(row);
    for (const Quantity& quantity : kQuantities) {
      text += "," + (row.has_trajectory ? Exact(row.*quantity.value) : std::string());
    }
    text += "," + Quoted(row.error) + "\n";
  }
  return text;
}

nlohmann::json SweepJson(const std::string& sweep, const SweepGrid& grid, const std::vector<SweepRow>& rows) {
  nlohmann::json points = nlohmann::json::array();
  for (size_t i = 0; i < rows.size(); ++i) {
    const SweepRow& row = rows[i];
    nlohmann::json point = {{"solve", row.solve}, {"state", v1::SolveState_Name(row.state)}};
    for (size_t k = 0; k < grid.axes.size(); ++k) point[grid.axes[k].column] = grid.points[i].values[k];
    if (row.state == v1::SOLVE_STATE_SUCCEEDED) {
      point["termination"] = v1::Termination_Name(row.outcome.termination());
      point["verdict"] = v1::Verdict_Name(row.outcome.verdict());
    }
    for (const Quantity& quantity : kQuantities) {
      if (row.has_trajectory) point[quantity.column] = row.*quantity.value;
    }
    if (!row.error.empty()) point["error"] = row.error;
    points.push_back(std::move(point));
  }
  return {{"sweep", sweep}, {"points", std::move(points)}};
}

}  // namespace rollgait::client
