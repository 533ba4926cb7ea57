// A model in a file of the caller's.
#ifndef ROLLGAIT_CLIENT_IMPORT_MODEL_FILE_H_
#define ROLLGAIT_CLIENT_IMPORT_MODEL_FILE_H_

#include <string>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// Whether a word that names a model is a file: it ends in .json, or as files of a tree_file.h format do.
bool IsModelFile(const std::string& word);

struct ModelFile {
  v1::Model model;
  std::string explanation;  // of a tree: what was read, merged, assumed and left out, lines for people; else empty
};

// Reads rollgait.v1.Model as JSON, or a tree of links with its side file. Throws Failure(kUsage) for one without the
// other, and for what ReadJsonFile, ReadLinkTree, ReadSideFile and ModelOfTree refuse.
ModelFile ReadModelFile(const std::string& path, const std::string& side_path);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MODEL_FILE_H_
