#include "tests/reference_check/report.h"

#include <cmath>
#include <cstdio>
#include <ostream>

namespace rollgait::reference {

void Report::Add(const std::string& family, const std::string& field, const std::string& where, Real error,
                 Real tolerance) {
  Row* row = nullptr;
  for (Row& candidate : rows_) {
    if (candidate.family == family && candidate.field == field) row = &candidate;
  }
  if (row == nullptr) {
    rows_.push_back({family, field, 0, 0, 0, ""});
    row = &rows_.back();
  }
  const Real kWorst = std::numeric_limits<Real>::infinity();
  const Real ratio = std::isnan(error) ? kWorst : error == 0 ? 0 : tolerance > 0 ? error / tolerance : kWorst;
  ++row->cases;
  if (std::isnan(error) || error > row->worst_error) row->worst_error = std::isnan(error) ? kWorst : error;
  if (row->worst_case.empty() || ratio > row->worst_ratio) {
    row->worst_ratio = ratio;
    row->worst_case = where;
  }
}

bool Report::passed() const { return Exceeded().empty(); }

std::set<std::string> Report::Exceeded() const {
  std::set<std::string> fields;
  for (const Row& row : rows_) {
    if (!(row.worst_ratio <= 1)) fields.insert(row.field);
  }
  return fields;
}

void Report::Print(std::ostream& out) const {
  char line[256];
  std::snprintf(line, sizeof(line), "%-22s %-30s %7s %13s %11s  %s\n", "family", "field", "cases", "worst error",
                "/tolerance", "worst case");
  out << line;
  for (const Row& row : rows_) {
    std::snprintf(line, sizeof(line), "%-22s %-30s %7d %13.3Le %11.3Lg  %s%s\n", row.family.c_str(), row.field.c_str(),
                  row.cases, row.worst_error, row.worst_ratio, row.worst_case.c_str(),
                  row.worst_ratio <= 1 ? "" : "  EXCEEDS");
    out << line;
  }
}

}  // namespace rollgait::reference
