// The accuracy report line by line: the same lines on the terminal and in the HTML report.
#ifndef ROLLGAIT_CLIENT_ACCURACY_TABLE_H_
#define ROLLGAIT_CLIENT_ACCURACY_TABLE_H_

#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct AccuracyLine {
  std::string name;                  // "gap of a contact that rolls"
  double value;                      // in `unit`
  std::string unit;                  // "mm"; may be empty
  std::string where;                 // "hip_l at 0.123 s"; may be empty
  std::string explanation;           // a sentence for a person who did not write the solver
  std::optional<double> bound = {};  // largest admissible value, in `unit`; absent: not judged
  bool exceeded = false;             // there is a bound and the value is not within it
};

// A line for each criterion that the server judges by, then the further figures of the report of a finished solve.
std::vector<AccuracyLine> AccuracyLines(const v1::Solve& solve);

// "within the requested bounds"; "EXCEEDED: " and what is furthest beyond its bound, by how much, where and when; "not
// judged", with the reason.
std::string AccuracyVerdict(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_ACCURACY_TABLE_H_
