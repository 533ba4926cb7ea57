// The numbers of the report, as the page's script reads them.
#ifndef ROLLGAIT_CLIENT_REPORT_REPORT_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_REPORT_DATA_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// {title, solves: [...]}; the members of a solve are named where they are made. Angles in degrees, forces in % of body
// weight, percentages of the gait cycle, everything else SI. Curves are sampled at 201 equal steps from 0 to 100 %.
// Throws Failure(kUsage) if a trajectory does not fit its model.
nlohmann::json ReportData(const std::vector<v1::Solve>& solves, const std::string& title);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_REPORT_DATA_H_
