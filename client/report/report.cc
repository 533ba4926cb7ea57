#include "client/report/report.h"

#include <map>

#include "client/report/assets.h"

namespace rollgait::client {
namespace {

// The template with each {{mark}} replaced. One pass: what is filled in is not looked at again.
std::string Fill(const std::string& page, const std::map<std::string, std::string>& values) {
  std::string filled;
  size_t from = 0;
  for (size_t open = page.find("{{"); open != std::string::npos; open = page.find("{{", from)) {
    const size_t close = page.find("}}", open);
    filled += page.substr(from, open - from) + values.at(page.substr(open + 2, close - open - 2));
    from = close + 2;
  }
  return filled + page.substr(from);
}

std::string EscapeHtml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

// JSON that cannot end the script element it stands in.
std::string EscapeScript(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '<' ? "\\u003c" : std::string(1, c);
  return escaped;
}

// The page of `data` with the script that puts it together.
std::string Page(const nlohmann::json& data, const char* script, const std::string& nonce) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return Fill(kReportHtml, {{"title", EscapeHtml(data.at("title"))},
                            {"policy", PagePolicy(nonce)},
                            {"nonce", nonce.empty() ? "" : " nonce=\"" + nonce + "\""},
                            {"style", kReportCss},
                            {"three", kThreeJs},
                            {"script", std::string(kReportScript) + script},
                            {"data", EscapeScript(text)}});
}

}  // namespace

std::string PagePolicy(const std::string& nonce) {
  const std::string common = "default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; ";
  if (nonce.empty()) return common + "script-src 'unsafe-inline'";
  return common + "script-src 'nonce-" + nonce + "'; connect-src 'self'; base-uri 'none'; form-action 'none'";
}

std::string ReportHtml(const std::vector<ReportedSolve>& solves, const std::string& title, const std::string& nonce) {
  return Page(ReportData(solves, title), kReportGaitsJs, nonce);
}

std::string LiveHtml(const v1::Solve& solve, const std::string& nonce) {
  return Page(LiveData(solve), kReportLiveJs, nonce);
}

std::string PageHtml(const std::vector<ReportedSolve>& solves, const std::string& title, const nlohmann::json& paper) {
  nlohmann::json data = ReportData(solves, title);
  data["paper"] = paper;
  return Page(data, kReportPaperJs, "");
}

std::string TradeoffHtml(const nlohmann::json& tradeoff) {
  nlohmann::json data = ReportData({}, "Time against error");
  data["tradeoff"] = tradeoff;
  return Page(data, kReportTradeoffJs, "");
}

}  // namespace rollgait::client
