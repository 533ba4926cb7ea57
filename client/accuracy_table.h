// The accuracy report line by line: the same lines on the terminal and in the HTML report.
#ifndef ROLLGAIT_CLIENT_ACCURACY_TABLE_H_
#define ROLLGAIT_CLIENT_ACCURACY_TABLE_H_

#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct AccuracyLine {
  std::string name;         // "largest gap"
  double value;             // in `unit`
  std::string unit;         // "mm"; may be empty
  std::string where;        // "hip_l at 0.123 s"; may be empty
  std::string explanation;  // a sentence for a person who did not write the solver
  // The request bounds the figure from above by this, in `unit`.
  std::optional<double> bound;
};

// Every figure of the report of a finished solve, bounds as the request's accuracy level and overrides state them.
std::vector<AccuracyLine> AccuracyLines(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_ACCURACY_TABLE_H_
