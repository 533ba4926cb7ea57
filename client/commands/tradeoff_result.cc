#include "client/commands/tradeoff_result.h"

#include <filesystem>
#include <ostream>

#include "client/json.h"
#include "client/output.h"
#include "client/report/report.h"

namespace rollgait::client {

void WriteTradeoff(const TradeoffTable& table, const std::string& folder, const GlobalOptions& global,
                   const Terminal& terminal) {
  const nlohmann::json data = TradeoffJson(table);
  if (!folder.empty()) {
    const std::filesystem::path path = folder;
    WriteDocument(TradeoffCsv(table), (path / "tradeoff.csv").string(), terminal.out);
    WriteFile((path / "tradeoff.json").string(), data.dump(2) + "\n");
    WriteDocument(TradeoffHtml(data), (path / "tradeoff.html").string(), terminal.out);
  }
  if (global.json) {
    terminal.out << data.dump() << std::endl;
  } else if (!global.quiet) {
    terminal.out << TradeoffText(table) << std::flush;
  }
}

}  // namespace rollgait::client
