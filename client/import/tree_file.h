// Files that describe bodies, by format: one reader for each, and one tree for all.
#ifndef ROLLGAIT_CLIENT_IMPORT_TREE_FILE_H_
#define ROLLGAIT_CLIENT_IMPORT_TREE_FILE_H_

#include <string>
#include <vector>

#include "client/import/link_tree.h"

namespace tinyxml2 {
class XMLDocument;
}

namespace rollgait::client {

struct TreeFormat {
  const char* name;                  // "MJCF", for people
  std::vector<const char*> endings;  // of files
  const char* root;                  // name of the root element, which decides
  LinkTree (*read)(const std::string& path, const tinyxml2::XMLDocument& xml);
};
const std::vector<TreeFormat>& TreeFormats();

// Whether the word ends as files of one of the formats do.
bool IsTreeFile(const std::string& word);
// ".urdf, .xml, .mjcf or .osim".
std::string TreeFileEndings();

// Reads and checks a file: ParseSafeXml, the reader of its root element, FinishTree. Opens no file and no address that
// it names. Throws Failure(kUsage) with file, element and reason, and the line where the text itself is wrong.
LinkTree ReadLinkTree(const std::string& path);
// The same for text. `path` is for messages only.
LinkTree ReadLinkTreeText(const std::string& path, const std::string& text);

// The content of a file, or its first kMaxXmlBytes + 1 bytes. Throws Failure(kUsage) if it cannot be read.
std::string ReadModelBytes(const std::string& path);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_TREE_FILE_H_
