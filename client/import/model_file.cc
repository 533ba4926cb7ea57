#include "client/import/model_file.h"

#include <utility>

#include "client/failure.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "client/json.h"

namespace rollgait::client {
namespace {

std::string Explain(const ImportedModel& model) {
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

bool IsModelFile(const std::string& word) { return word.ends_with(".json") || IsTreeFile(word); }

ModelFile ReadModelFile(const std::string& path, const std::string& side_path) {
  if (!IsTreeFile(path)) {
    if (!side_path.empty())
      throw Failure(ExitCode::kUsage, "--side: belongs to a model in a " + TreeFileEndings() + " file, not to " + path);
    ModelFile file;
    ReadJsonFile(path, file.model, kModelFile);
    return file;
  }
  if (side_path.empty()) {
    throw Failure(ExitCode::kUsage,
                  path +
                      ": says neither what the feet are nor what its joints do; add --side FILE.json. "
                      "`rollgait models " +
                      path + " --propose-side` writes one to begin with");
  }
  const ImportedModel imported = ReadImportedModel(path, side_path);
  return {imported.model, Explain(imported)};
}

}  // namespace rollgait::client
