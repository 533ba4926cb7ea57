#include "client/help_topics.h"

#include "client/formats/format_table.h"
#include "client/repeated_flags.h"

namespace rollgait::client {
namespace {

constexpr char kExitCodes[] =
    R"(  0  done; a solve that was waited for is optimal or acceptable, within its accuracy bounds or not judged (draft)
  1  internal error, here or in the server, or a file that could not be written
  2  wrong command line, or a request that the server refuses (INVALID_ARGUMENT, a token that is missing or not enough)
  3  no server, no answer in time, or a server too busy to answer
  4  the solve ended without a solution: infeasible, not converged, or out of time before anything was judged; a simulation ended early; no periodic gait found
  5  the run failed: crash, CPU limit or memory limit
  6  cancelled
  7  no such solve or model; no measured solve is near enough for --predict
  8  there is a solution, but the trajectory misses an accuracy bound or a --max-error
     When the time was up (--max-time) the code is that of the verdict on the newest solution.
)";

constexpr char kSettings[] =
    R"(Every flag of `rollgait --help` also has an environment variable and a key in the configuration file. A flag on the
command line comes first, then the environment, then the file. --tls-ca is ROLLGAIT_TLS_CA and tls-ca:

  # ~/.config/rollgait/config.toml
  server = "gait.example.org:443"
  tls-ca = "/etc/rollgait/ca.pem"
  token-file = "/etc/rollgait/token"
  timeout = 60

The file is $ROLLGAIT_CONFIG (empty: none), else rollgait/config.toml in $XDG_CONFIG_HOME, else in ~/.config. A key that
is not such a flag is refused. An environment variable that is empty counts as not set.

  ROLLGAIT_TOKEN   token for the server, unless a token file is given
  NO_COLOR         any non-empty value: no colours
)";

std::string FormatLines() {
  std::string text;
  for (const Format& format : Formats()) {
    const std::string ending = format.ending.empty() ? "folder" : format.ending;
    text += "  " + format.name + std::string(format.name.size() < 10 ? 10 - format.name.size() : 1, ' ') + ending +
            std::string(ending.size() < 8 ? 8 - ending.size() : 1, ' ') + format.what + "\n";
  }
  return text + "docs/reference/formats.md has their axes, units and names.\n";
}

}  // namespace

const std::vector<HelpTopic>& HelpTopics() {
  static const std::vector<HelpTopic> topics = {
      {"exit-codes", "what the exit code says", kExitCodes},
      {"settings", "environment variables and the configuration file", kSettings},
      {"formats", "formats of export and --output", FormatLines()},
      {"repeated-flags", "flags that may be repeated, and what they do to a file", kRepeatedFlagsRule},
  };
  return topics;
}

}  // namespace rollgait::client
