// The commands of `rollgait`. Each writes data to terminal.out, everything else to terminal.err, returns the exit code
// of what it did, and throws Failure for what it could not do.
#ifndef ROLLGAIT_CLIENT_COMMANDS_COMMANDS_H_
#define ROLLGAIT_CLIENT_COMMANDS_COMMANDS_H_

#include <optional>
#include <string>
#include <vector>

#include "client/connection.h"
#include "client/failure.h"
#include "client/list_filter.h"
#include "client/spec_flags.h"
#include "client/terminal.h"

namespace rollgait::client {

struct SolveOptions {
  SpecFlags spec;
  std::vector<std::string> labels;  // "KEY=VALUE"
  std::string request_id;
  std::string output;
  int priority = 0;
  bool validate_only = false;
  bool predict = false;  // says what the solve will take, and asks no server
  bool detach = false;
  double reconnect_s = 60;
};
// Creates a solve and follows it to its end; Ctrl-C cancels it.
ExitCode RunSolve(const SolveOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct WatchOptions {
  std::string name;
  int64_t after_sequence = 0;
  std::string output;
  double reconnect_s = 60;
};
// Follows a solve; Ctrl-C leaves it alone.
ExitCode RunWatch(const WatchOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct GetOptions {
  std::string name;
  std::string output;
};
ExitCode RunGet(const GetOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ExplainOptions {
  std::string solve;  // a name on the server, or a .json file
};
// How a finished solve ended, in sentences.
ExitCode RunExplain(const ExplainOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ListOptions {
  ListFilter filter;
  int limit = 50;
};
ExitCode RunList(const ListOptions& options, const GlobalOptions& global, const Terminal& terminal);

// By name, and those of the caller's that carry all of the labels ("KEY=VALUE"): to cancel, what is queued or runs; to
// delete, what has ended; to change the priority, what is queued.
struct ChosenSolves {
  std::vector<std::string> names, labels;
};
// The last exit code that is not success, if there is one; every solve is tried. kUsage if none is named.
ExitCode RunCancel(const ChosenSolves& chosen, const GlobalOptions& global, const Terminal& terminal);
ExitCode RunDelete(const ChosenSolves& chosen, const GlobalOptions& global, const Terminal& terminal);

struct PriorityOptions {
  ChosenSolves chosen;
  int priority = 0;
};
// Changes that of queued solves. As RunCancel.
ExitCode RunPriority(const PriorityOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ModelsOptions {
  SpecFlags flags;
  std::string format;               // of format_table.h; empty: a table for people
  std::string output;               // with a format: a file; empty or "-": terminal.out
  std::optional<double> slope_deg;  // of the ground that the model stands on, with a format
  bool propose_side = false;        // of a URDF, MJCF or .osim file: print a side file to begin with
};
// Without a model name in the flags: the list; with one: the whole model.
ExitCode RunModels(const ModelsOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ExportOptions {
  std::string solve;   // a name on the server, or a .json file
  std::string format;  // empty: by the ending of `output`
  std::string output;  // a file, a folder for formats of several files; empty or "-": terminal.out
};
// Writes a finished solve in one of the formats.
ExitCode RunExport(const ExportOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct SpecOptions {
  SpecFlags spec;
  std::string output;  // a file; empty or "-": terminal.out
  bool keep_preset = false;
};
// The request as proto3 JSON. The server is asked only where there is a preset to spell out; without a server that
// answers, the preset stays, and terminal.err says so.
ExitCode RunSpec(const SpecOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ReportOptions {
  std::vector<std::string> solves;  // names on the server, or .json files
  std::string output;
  std::string title;
  bool without_people = false;  // no curves of people beside those of a human model
};
ExitCode RunReport(const ReportOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ViewOptions {
  std::string solve;   // a name on the server, or a .json file; empty: the caller's newest
  int port = 0;        // 0: any free one
  bool opens = false;  // starts the desktop's browser
  double reconnect_s = 60;
};
// Serves the page about a solve on this machine, with the newest iterate while it runs, until Ctrl-C. Writes the
// address to terminal.out. Success after Ctrl-C, whatever became of the solve.
ExitCode RunView(const ViewOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct ReproducePaperOptions {
  SpecFlags spec;  // the slope is the command's own
  std::string output;
  double reconnect_s = 60;
};
// Solves +10°, 0° and −10° one after the other and lays them beside the paper: a page, or with --json the data on
// terminal.out. The exit code of the first solve that has no answer; Ctrl-C cancels the one that runs and ends.
ExitCode RunReproducePaper(const ReproducePaperOptions& options, const GlobalOptions& global, const Terminal& terminal);

// Success: the server says that it serves; kUnreachable: it does not, or says otherwise.
ExitCode RunHealth(const GlobalOptions& global, const Terminal& terminal);
ExitCode RunServerInfo(const GlobalOptions& global, const Terminal& terminal);
// Checks certificates, connection, versions, clocks, access, queue and disk, a line each; kUnreachable if a check
// fails.
ExitCode RunDoctor(const GlobalOptions& global, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_COMMANDS_H_
