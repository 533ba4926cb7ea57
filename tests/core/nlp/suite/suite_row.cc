#include "tests/core/nlp/suite/suite_row.h"

#include <iterator>
#include <utility>

namespace rollgait::suite {

std::vector<Interval> Each(int n, const Interval& interval) {
  return std::vector<Interval>(static_cast<size_t>(n), interval);
}

SuiteRow Row(const std::string& name, const std::vector<double>& start, const std::vector<Interval>& variables,
             const std::vector<Interval>& rows, const Formula& formula, const Answer& answer) {
  return {name, [=] { return std::make_unique<FormulaProgram>(formula, variables, rows); }, start, answer};
}

std::vector<SuiteRow> SuiteRows() {
  std::vector<SuiteRow> all;
  for (const auto& part :
       {HockSchittkowskiSmall, HockSchittkowskiLarge, CuteRows, DegenerateRows, InfeasibleRows, ChainRows}) {
    std::vector<SuiteRow> rows = part();
    std::move(rows.begin(), rows.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace rollgait::suite
