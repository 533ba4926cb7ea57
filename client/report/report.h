// The HTML report: one page without references to the network.
#ifndef ROLLGAIT_CLIENT_REPORT_REPORT_H_
#define ROLLGAIT_CLIENT_REPORT_REPORT_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/report/report_data.h"

namespace rollgait::client {

// What a page may do. `nonce` empty: a file; its own scripts run, and nothing else is loaded. Else a page that a server
// hands out: only scripts with this nonce run, and it may ask that server. The Content-Security-Policy of both.
std::string PagePolicy(const std::string& nonce);

// The page about finished solves, in the given order. An empty title gives "Optimal gait" or "Optimal gaits". `nonce`
// as above: letters and digits. Throws Failure(kUsage) if a trajectory does not fit its model.
std::string ReportHtml(const std::vector<ReportedSolve>& solves, const std::string& title,
                       const std::string& nonce = "");

// The page about a solve that waits or runs: it asks for the events of "events", relative to its own address (see
// client/view/live_feed.h), and loads itself again at their end.
std::string LiveHtml(const v1::Solve& solve, const std::string& nonce);

// The page that lays these solves beside the paper; `paper` as PaperData makes it.
std::string PageHtml(const std::vector<ReportedSolve>& solves, const std::string& title, const nlohmann::json& paper);

// The page of `rollgait tradeoff`; `tradeoff` as TradeoffJson makes it.
std::string TradeoffHtml(const nlohmann::json& tradeoff);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_REPORT_H_
