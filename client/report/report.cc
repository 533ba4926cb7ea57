#include "client/report/report.h"

#include "client/report/assets.h"
#include "client/report/report_data.h"

namespace rollgait::client {
namespace {

// Puts `value` where `mark` stands once in `text`.
void Insert(std::string& text, const std::string& mark, const std::string& value) {
  const size_t place = text.find(mark);
  text.replace(place, mark.size(), value);
}

std::string EscapeHtml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

// JSON that cannot end the script element it stands in.
std::string EscapeScript(const std::string& json) {
  std::string escaped;
  for (const char c : json) escaped += c == '<' ? "\\u003c" : std::string(1, c);
  return escaped;
}

}  // namespace

std::string ReportHtml(const std::vector<v1::Solve>& solves, const std::string& title) {
  const nlohmann::json data = ReportData(solves, title);
  std::string page = kReportHtml;
  Insert(page, "{{title}}", EscapeHtml(data.at("title")));
  Insert(page, "{{style}}", kReportCss);
  Insert(page, "{{script}}", std::string(kReportChartsJs) + kReportWalkerJs + kReportPageJs);
  // Last, so that nothing in the data can be taken for a mark.
  Insert(page, "{{data}}", EscapeScript(data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
  return page;
}

}  // namespace rollgait::client
