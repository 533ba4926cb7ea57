// The HTML report: one page without references to the network.
#ifndef ROLLGAIT_CLIENT_REPORT_REPORT_H_
#define ROLLGAIT_CLIENT_REPORT_REPORT_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/report/report_data.h"

namespace rollgait::client {

// The page about finished solves, in the given order. An empty title gives "Optimal gait" or "Optimal gaits".
// Throws Failure(kUsage) if a trajectory does not fit its model.
std::string ReportHtml(const std::vector<ReportedSolve>& solves, const std::string& title);

// The page that lays these solves beside the paper; `paper` as PaperData makes it.
std::string PageHtml(const std::vector<ReportedSolve>& solves, const std::string& title, const nlohmann::json& paper);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_REPORT_H_
