#include "client/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <ostream>

#include "client/failure.h"
#include "client/json.h"

namespace rollgait::client {
namespace {

// "--output FILE: cannot write in DIRECTORY: why", where it cannot.
void RequireWritable(const std::string& directory, const std::string& given) {
  const std::string place = directory.empty() ? "." : directory;
  if (access(place.c_str(), W_OK | X_OK) != 0) {
    throw Failure(ExitCode::kUsage, "--output " + given + ": cannot write in " + place + ": " + std::strerror(errno));
  }
}

}  // namespace

bool IsStandardOutput(const std::string& path) { return path == "-"; }

std::ostream& TextStream(const std::string& output, const Terminal& terminal) {
  return IsStandardOutput(output) ? terminal.err : terminal.out;
}

void RequireOneDocument(const std::string& output, bool json) {
  if (!json || !IsStandardOutput(output)) return;
  throw Failure(ExitCode::kUsage, "--output - with --json: both write to standard output; leave one of the two out");
}

void RequireOutputPath(const std::string& path) {
  if (IsStandardOutput(path)) return;
  FormatOfPath(path, "--output");
  RequireWritable(std::filesystem::path(path).parent_path().string(), path);
}

void RequireOutput(const std::string& path, const Format& format) {
  if (format.folder_of_solve) {
    if (path.empty() || path == "-") {
      throw Failure(ExitCode::kUsage, "--format " + format.name + ": several files; name their folder with --output");
    }
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw Failure(ExitCode::kUsage, "--output " + path + ": no such folder: " + error.message());
    RequireWritable(path, path);
  } else if (!path.empty() && path != "-") {
    if (std::filesystem::is_directory(path)) {
      throw Failure(ExitCode::kUsage, "--output " + path + ": is a folder; --format " + format.name + " is one file");
    }
    RequireWritable(std::filesystem::path(path).parent_path().string(), path);
  }
}

void WriteExport(const std::vector<ExportedFile>& files, const std::string& path, std::ostream& out) {
  if (path.empty() || IsStandardOutput(path)) {
    for (const ExportedFile& file : files) out << file.content;
    out << std::flush;
    if (!out) throw Failure(ExitCode::kInternal, "standard output cannot be written");
    return;
  }
  for (const ExportedFile& file : files) {
    WriteFile(file.name.empty() ? path : (std::filesystem::path(path) / file.name).string(), file.content);
  }
}

void WriteSolve(const v1::Solve& solve, const std::string& path, std::ostream& out) {
  const std::string file = IsStandardOutput(path) ? "solve.json" : path;
  WriteExport(ExportSolve(solve, FormatOfPath(file, "--output")), path, out);
}

void WriteDocument(const std::string& text, const std::string& path, std::ostream& out) {
  WriteExport({{"", text}}, path, out);
}

}  // namespace rollgait::client
