// Every format of results and models. docs/reference/formats.md states the axes, units and names of each.
#ifndef ROLLGAIT_CLIENT_FORMATS_FORMAT_TABLE_H_
#define ROLLGAIT_CLIENT_FORMATS_FORMAT_TABLE_H_

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "client/formats/ground.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct ExportedFile {
  std::string name;  // in the folder that is written
  std::string content;
};

// One row of the table: exactly one of the three functions is set.
struct Format {
  std::string name;    // "mjcf", for --format
  std::string ending;  // ".xml"; that of a folder is empty. The first row with an ending is meant by it.
  std::string what;    // for help, a few words
  // A model alone, or that of a solve on the solve's ground.
  std::function<std::string(const v1::Model&, const Ground&)> of_model = nullptr;
  // Of a solve that has a trajectory, or any for .json.
  std::function<std::string(const v1::Solve&)> of_solve = nullptr;
  // Several files that refer to each other.
  std::function<std::vector<ExportedFile>(const v1::Solve&)> folder_of_solve = nullptr;
};

const std::vector<Format>& Formats();

// Throws Failure(kUsage) that lists the names for one that is not in the table.
const Format& FindFormat(const std::string& name);

// The same for a model without a solve: also throws for a format that needs a solve. `of_model` is set.
const Format& FindModelFormat(const std::string& name);

// The format that the ending of a path stands for. Throws Failure(kUsage) that names `flag` and lists the endings.
const Format& FormatOfPath(const std::string& path, std::string_view flag);

// "mjcf, urdf": the formats of a model alone, or of a solve.
std::string ModelFormatNames();
std::string SolveFormatNames();

// The files of a solve; one without a name unless the format is a folder. Throws Failure(kNoSolution) if the format
// needs a trajectory and there is none, Failure(kUsage) where model and trajectory do not fit.
std::vector<ExportedFile> ExportSolve(const v1::Solve& solve, const Format& format);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_FORMAT_TABLE_H_
