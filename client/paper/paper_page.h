// The page and the data of `rollgait reproduce-paper`.
#ifndef ROLLGAIT_CLIENT_PAPER_PAPER_PAGE_H_
#define ROLLGAIT_CLIENT_PAPER_PAPER_PAGE_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// {slopes: [{slope_deg, solve, solved, stride_time_s, stride_length_m, events_percent, phases, joints, total,
// torques}],
//  statements: [{where, paper, ours, verdict, why}]}
// torques: {percent, hip, knee, ankle} of the right leg, N m, at 101 instants. Contract: the solves of +10°, 0° and
// −10°, in this order. Throws Failure(kUsage) if a trajectory does not fit its model.
nlohmann::json PaperData(const std::vector<v1::Solve>& solves);

// One page without references to the network: the paper's Figure 2 from these solves, and the statements.
std::string PaperHtml(const std::vector<v1::Solve>& solves);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PAPER_PAPER_PAGE_H_
