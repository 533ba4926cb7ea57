// What `rollgait tradeoff` found, of solves and of simulations: a row has settings, CPU time and errors.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_TRADEOFF_TABLE_H_
#define ROLLGAIT_CLIENT_TRADEOFF_TRADEOFF_TABLE_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rollgait::client {

struct TradeoffColumn {
  std::string name;                     // in files
  std::string title;                    // for people, with the unit; empty: in files only
  double scale = 1;                     // of the number for people
  int digits = 4;                       // likewise
  std::string picture = "", unit = "";  // what is drawn against CPU time; empty: nothing
};

struct TradeoffTable {
  std::string name;       // a digest of what was asked
  std::string reference;  // what the errors are against; empty: there is none, and no error is known
  // Among them cpu_time_s [s], well_known (of the error of the front) and on_front.
  std::vector<TradeoffColumn> columns;
  std::string error;   // the column of the front
  std::string same;    // the column that is "same" in rows that have found what the reference has
  std::string series;  // the column whose values are drawn in colours of their own
  // Objects: a word, a number or a truth by the name of its column; what is not known is missing. Names without a
  // column stand in the JSON document only.
  std::vector<nlohmann::json> rows;
};

// Adds a row without its cells that are no finite numbers: what is not known is missing, in every file alike.
void AddRow(TradeoffTable& table, nlohmann::json row);

// Sets on_front in every row: true in those that have found what the reference has and of which no other such row is
// as fast and as accurate, and better in one.
void MarkFront(TradeoffTable& table);

// For people, "?" before an error of the front that is not known well; comma separated values with a line of names
// (RFC 4180); {"tradeoff", "reference", "columns", "points" …}.
std::string TradeoffText(const TradeoffTable& table);
std::string TradeoffCsv(const TradeoffTable& table);
nlohmann::json TradeoffJson(const TradeoffTable& table);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_TRADEOFF_TABLE_H_
