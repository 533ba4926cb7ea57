// The numbers of the report, as the page's script reads them.
#ifndef ROLLGAIT_CLIENT_REPORT_REPORT_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_REPORT_DATA_H_

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// A finished solve, and the lines of the solver's log where they are known.
struct ReportedSolve {
  ReportedSolve(v1::Solve solve_, std::vector<v1::Iteration> iterations_ = {})  // NOLINT: a solve is one without a log
      : solve(std::move(solve_)), iterations(std::move(iterations_)) {}
  v1::Solve solve;
  std::vector<v1::Iteration> iterations;
};

// {title, program, datasets: [...], solves: [...]}; the members of a solve are named where they are made. Angles in
// degrees, forces in % of body weight, percentages of the gait cycle, everything else SI. Curves have 201 equal steps
// from 0 to 100 %. datasets: the normative data that gaits are compared with, as NormativeDatasetComparison without
// what belongs to one gait. Throws Failure(kUsage) if a trajectory does not fit its model.
nlohmann::json ReportData(const std::vector<ReportedSolve>& solves, const std::string& title);

// The same of a solve that waits or runs: what is known of it, and no motion.
nlohmann::json LiveData(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_REPORT_DATA_H_
