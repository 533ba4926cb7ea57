#include "client/tradeoff/tradeoff_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "client/formats/exact_number.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

constexpr char kTime[] = "cpu_time_s";

std::string TextOf(const TradeoffTable& table, const TradeoffColumn& column, const json& row) {
  const auto cell = row.find(column.name);
  if (cell == row.end()) return "-";
  if (cell->is_string()) return cell->get<std::string>();
  if (cell->is_boolean()) return cell->get<bool>() ? "yes" : "no";
  const std::string mark = column.name == table.error && !row.value("well_known", false) ? "?" : "";
  return mark + FormatNumber(column.scale * cell->get<double>(), column.digits);
}

std::string CsvOf(const json& row, const std::string& name) {
  const auto cell = row.find(name);
  if (cell == row.end()) return "";
  if (cell->is_string()) return cell->get<std::string>();
  if (cell->is_boolean()) return cell->get<bool>() ? "1" : "0";
  return Exact(cell->get<double>());
}

// Words are flush left.
bool HasWords(const TradeoffTable& table, const std::string& name) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const json& row) { return row.contains(name) && row.at(name).is_string(); });
}

}  // namespace

void AddRow(TradeoffTable& table, json row) {
  for (auto cell = row.begin(); cell != row.end();) {
    const bool known = !cell->is_number_float() || std::isfinite(cell->get<double>());
    cell = known ? std::next(cell) : row.erase(cell);
  }
  table.rows.push_back(std::move(row));
}

void MarkFront(TradeoffTable& table) {
  const auto may_be = [&](const json& row) {
    return row.contains(kTime) && row.contains(table.error) && row.value(table.same, "") == "same";
  };
  for (json& row : table.rows) {
    const auto beats = [&](const json& other) {
      if (!may_be(other)) return false;
      const double time = row.at(kTime), others_time = other.at(kTime);
      const double error = row.at(table.error), others_error = other.at(table.error);
      return others_time <= time && others_error <= error && (others_time < time || others_error < error);
    };
    row["on_front"] = may_be(row) && std::none_of(table.rows.begin(), table.rows.end(), beats);
  }
}

std::string TradeoffText(const TradeoffTable& table) {
  std::vector<std::vector<std::string>> cells = {{"front"}};
  std::string alignment = "l";
  for (const TradeoffColumn& column : table.columns) {
    if (column.title.empty()) continue;
    cells.front().push_back(column.title);
    alignment += HasWords(table, column.name) ? 'l' : 'r';
  }
  for (const json& row : table.rows) {
    std::vector<std::string>& line = cells.emplace_back();
    line.push_back(row.value("on_front", false) ? "*" : "");
    for (const TradeoffColumn& column : table.columns) {
      if (!column.title.empty()) line.push_back(TextOf(table, column, row));
    }
  }
  return FormatTable(cells, alignment);
}

std::string TradeoffCsv(const TradeoffTable& table) {
  std::string text;
  for (const TradeoffColumn& column : table.columns) text += (text.empty() ? "" : ",") + column.name;
  for (const json& row : table.rows) {
    std::string separator = "\n";
    for (const TradeoffColumn& column : table.columns) {
      text += separator + CsvOf(row, column.name);
      separator = ",";
    }
  }
  return text + "\n";
}

json TradeoffJson(const TradeoffTable& table) {
  json columns = json::array();
  for (const TradeoffColumn& column : table.columns) {
    json described = {{"name", column.name}};
    if (!column.title.empty()) {
      described["title"] = column.title;
      described["scale"] = column.scale;
      described["digits"] = column.digits;
    }
    if (!column.picture.empty()) {
      described["picture"] = column.picture;
      described["unit"] = column.unit;
    }
    columns.push_back(std::move(described));
  }
  json data = {{"tradeoff", table.name}, {"columns", std::move(columns)}, {"error", table.error},
               {"same", table.same},     {"series", table.series},        {"points", table.rows}};
  if (!table.reference.empty()) data["reference"] = table.reference;
  return data;
}

}  // namespace rollgait::client
