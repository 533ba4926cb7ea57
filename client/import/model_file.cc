#include "client/import/model_file.h"

#include <utility>

#include "client/failure.h"
#include "client/import/urdf_model.h"
#include "client/json.h"

namespace rollgait::client {
namespace {

std::string ExplainUrdfModel(const UrdfModel& model) {
  std::string text;
  const std::pair<const char*, const std::vector<std::string>*> parts[] = {
      {"Read", &model.read}, {"Merged", &model.merged}, {"Assumed", &model.assumed}, {"Left out", &model.left_out}};
  for (const auto& [title, lines] : parts) {
    if (lines->empty()) continue;
    text += std::string(title) + "\n";
    for (const std::string& line : *lines) text += "  " + line + "\n";
  }
  return text;
}

}  // namespace

bool IsUrdfFile(const std::string& word) { return word.ends_with(".urdf"); }
bool IsModelFile(const std::string& word) { return word.ends_with(".json") || IsUrdfFile(word); }

ModelFile ReadModelFile(const std::string& path, const std::string& side_path) {
  if (!IsUrdfFile(path)) {
    if (!side_path.empty())
      throw Failure(ExitCode::kUsage, "--side: belongs to a model in a .urdf file, not to " + path);
    ModelFile file;
    ReadJsonFile(path, file.model);
    return file;
  }
  if (side_path.empty()) {
    throw Failure(ExitCode::kUsage,
                  path +
                      ": a URDF says neither what the feet are nor what its joints do; add --side FILE.json. "
                      "`rollgait models " +
                      path + " --propose-side` writes one to begin with");
  }
  const UrdfModel urdf = ReadUrdfModel(path, side_path);
  return {urdf.model, ExplainUrdfModel(urdf)};
}

}  // namespace rollgait::client
