#include "client/commands/commands.h"
#include "client/commands/follow.h"
#include "client/output.h"
#include "client/text.h"

namespace rollgait::client {

ExitCode RunWatch(const WatchOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!options.output.empty()) RequireOutputPath(options.output);
  RequireOneDocument(options.output, global.json);
  const std::string name = SolveName(options.name);
  Progress progress(terminal, ProgressStyle(global, terminal));
  CtrlC ctrl_c(CtrlC::Action::kStopWatching, progress);
  Connection connection(global);
  return FollowToEnd(connection, name, {options.after_sequence, options.reconnect_s}, options.output, ctrl_c, progress,
                     terminal);
}

}  // namespace rollgait::client
