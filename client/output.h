// A finished solve, or a model, as files.
#ifndef ROLLGAIT_CLIENT_OUTPUT_H_
#define ROLLGAIT_CLIENT_OUTPUT_H_

#include <iosfwd>
#include <string>
#include <vector>

#include "client/formats/format_table.h"
#include "client/terminal.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Whether --output names standard output: "-". Text for people then goes to standard error.
bool IsStandardOutput(const std::string& path);
std::ostream& TextStream(const std::string& output, const Terminal& terminal);

// Refuses --output - together with --json, since both would write to standard output. Throws Failure(kUsage).
void RequireOneDocument(const std::string& output, bool json);

// Refuses a path that WriteSolve could not write, before any work is done. Throws Failure(kUsage) if no format has its
// ending, or if the directory does not exist or is not writable. "-" is good.
void RequireOutputPath(const std::string& path);

// Writes the solve in the format that the path's ending stands for (format_table.h), or for "-" as JSON to `out`.
// Throws Failure(kNoSolution) if the format needs a trajectory and there is none, kInternal if writing fails.
void WriteSolve(const v1::Solve& solve, const std::string& path, std::ostream& out);

// Writes a document of one file, or for "-" to `out`. Throws Failure(kInternal) if writing fails.
void WriteDocument(const std::string& text, const std::string& path, std::ostream& out);

// The same for --format with --output: a folder is made if it does not exist; an empty path and "-" are standard
// output, which a format of several files refuses.
void RequireOutput(const std::string& path, const Format& format);
void WriteExport(const std::vector<ExportedFile>& files, const std::string& path, std::ostream& out);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_OUTPUT_H_
