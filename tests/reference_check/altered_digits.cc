// Every number of a reference file is looked at: one digit altered, reference_check must notice. Of each kind of number
// (its path without indices) the first that is not zero has its third digit changed, in the first case of the file.
// Trajectories are cut to their first rows; extremes and events of the whole are altered together, and each must be
// among the fields that exceed. Numbers that nothing is computed from are listed below.
//   altered_digits FILE.json WORK_FOLDER     ends with 1 and names the numbers whose change is not noticed
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/reference_check/trajectory.h"

namespace rollgait::reference {
namespace {

constexpr int kRows = 12;  // of a table that are kept

// Names, counts and what the references say of themselves.
const std::set<std::string> kNotComputed = {"id",
                                            "digits",
                                            "max_abs_energy_change",
                                            "reference_error_bound_orientation",
                                            "independent_check_max_abs_difference",
                                            "sensitivity_amplification_at_quarters"};

const Family& FamilyOf(const Document& document) {
  return *std::find_if(kFamilies, kFamilies + kFamilyCount,
                       [&](const Family& family) { return family.recognises(document); });
}

// What exceeds its tolerance. A file that is refused counts as noticed.
std::set<std::string> Exceeded(const Document& document) {
  Report report;
  try {
    FamilyOf(document).check(document, &report);
  } catch (const std::exception&) {
    return {"refused"};
  }
  return report.Exceeded();
}

// "1.2345e-2" with its third significant digit changed; empty if there are not three.
std::string Altered(const std::string& text) {
  std::string altered = text;
  int digits = 0;
  for (char& c : altered) {
    if (c == 'e' || c == 'E') break;
    if (c < '0' || c > '9' || (digits == 0 && c == '0')) continue;
    if (++digits == 3) {
      c = c < '5' ? static_cast<char>(c + 4) : static_cast<char>(c - 4);
      return altered;
    }
  }
  return "";
}

struct Place {
  std::string key;  // path without indices
  nlohmann::json::json_pointer at;
  Json changed = nullptr;
};

// The first alterable number of every key below `json`.
void Collect(const Json& json, const nlohmann::json::json_pointer& at, const std::string& key,
             std::vector<Place>* places) {
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) {
      if (kNotComputed.count(name) == 0) Collect(value, at / name, key.empty() ? name : key + "." + name, places);
    }
    return;
  }
  if (json.is_array()) {
    for (size_t i = 0; i < json.size(); ++i) Collect(json[i], at / i, key, places);
    return;
  }
  const auto known = [&](const Place& place) { return place.key == key; };
  if (std::any_of(places->begin(), places->end(), known)) return;
  const std::string text = json.is_string() ? json.get<std::string>() : json.is_number_float() ? json.dump() : "";
  char* end = nullptr;
  if (text.empty() || std::strtod(text.c_str(), &end) == 0 || *end != '\0' || Altered(text).empty()) return;
  places->push_back({key, at, nullptr});
}

std::vector<std::string> Lines(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

void WriteTable(const std::string& path, const std::vector<std::string>& lines) {
  std::ofstream file(path);
  for (const std::string& line : lines) file << line << "\n";
}

// The first number of the column that is not small has one digit altered; `what` stays empty if there is none.
std::vector<std::string> WithColumnAltered(std::vector<std::string> table, size_t column, std::string* what) {
  for (size_t row = 1; row < table.size(); ++row) {
    std::vector<std::string> cells;
    std::istringstream stream(table[row]);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (std::abs(std::stod(cells[column])) < 1e-3 || Altered(cells[column]).empty()) continue;
    *what = "row " + std::to_string(row) + " column " + std::to_string(column + 1) + " " + cells[column];
    cells[column] = Altered(cells[column]);
    table[row] = cells[0];
    for (size_t i = 1; i < cells.size(); ++i) table[row] += "," + cells[i];
    break;
  }
  return table;
}

int Main(const std::string& path, const std::string& work) {
  Document document = ReadDocument(path);
  Json& cases = document.json.is_array() ? document.json : document.json["cases"];
  cases = Json::array({cases[0]});
  std::vector<std::string> table;
  std::string table_path;
  if (cases[0].contains("file")) {
    const std::string name = cases[0]["file"];
    table = Lines(DirectoryOf(path) + name);
    table.resize(kRows + 1);
    cases[0]["parameters"]["t_end"] = (kRows - 1) * cases[0]["parameters"]["dt"].get<double>();
    std::filesystem::create_directories(work);
    document.path = work + "/altered.json";
    table_path = work + "/" + name;
    WriteTable(table_path, table);
  }
  const std::set<std::string> before = Exceeded(document);  // extremes and events of the rows that were cut
  int altered = 0, missed = 0;
  const auto noticed = [&] {
    ++altered;
    const std::set<std::string> now = Exceeded(document);
    return !std::includes(before.begin(), before.end(), now.begin(), now.end());
  };
  const auto miss = [&](const std::string& what) {
    std::cout << "not noticed: " << what << "\n";
    ++missed;
  };
  std::vector<Place> places, of_the_whole;
  Collect(cases[0], nlohmann::json::json_pointer(), "", &places);
  for (const Place& place : places) {
    Json& number = cases[0][place.at];
    const Json original = number;
    const std::string text = Altered(original.is_string() ? original.get<std::string>() : original.dump());
    number = original.is_string() ? Json(text) : Json(std::stod(text));
    const Json changed = number;
    if (!noticed()) of_the_whole.push_back({place.key, place.at, changed});
    number = original;
  }
  if (!table.empty()) {
    const auto columns = static_cast<size_t>(std::count(table[0].begin(), table[0].end(), ',')) + 1;
    for (size_t column = 0; column < columns; ++column) {
      std::string what;
      const std::vector<std::string> changed = WithColumnAltered(table, column, &what);
      if (what.empty()) continue;  // a column of zeros
      WriteTable(table_path, changed);
      if (!noticed()) miss(what);
    }
    Document whole = ReadDocument(path);
    for (const Place& place : of_the_whole) whole.json[0][place.at] = place.changed;
    const std::set<std::string> exceeded = Exceeded(whole);
    std::erase_if(of_the_whole,
                  [&](const Place& place) { return exceeded.count(place.key.substr(place.key.rfind('.') + 1)) > 0; });
  }
  for (const Place& place : of_the_whole) miss(place.key + " -> " + place.changed.dump());
  std::cout << altered << " numbers altered, " << missed << " not noticed\n";
  return altered > 5 && missed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rollgait::reference

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: altered_digits FILE.json WORK_FOLDER\n";
    return 2;
  }
  return rollgait::reference::Main(argv[1], argv[2]);
}
