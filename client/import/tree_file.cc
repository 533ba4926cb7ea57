#include "client/import/tree_file.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "client/failure.h"
#include "client/import/mjcf_tree.h"
#include "client/import/osim_tree.h"
#include "client/import/urdf_tree.h"
#include "client/import/xml_guard.h"
#include "client/text.h"

namespace rollgait::client {

const std::vector<TreeFormat>& TreeFormats() {
  static const std::vector<TreeFormat> formats = {{"URDF", {".urdf"}, "robot", ReadUrdf},
                                                  {"MJCF", {".xml", ".mjcf"}, "mujoco", ReadMjcf},
                                                  {"OpenSim", {".osim"}, "OpenSimDocument", ReadOsim}};
  return formats;
}

bool IsTreeFile(const std::string& word) {
  return std::any_of(TreeFormats().begin(), TreeFormats().end(), [&](const TreeFormat& format) {
    return std::any_of(format.endings.begin(), format.endings.end(),
                       [&](const char* ending) { return word.ends_with(ending); });
  });
}

std::string TreeFileEndings() {
  std::vector<std::string> endings;
  for (const TreeFormat& format : TreeFormats()) {
    endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  }
  std::string text;
  for (size_t i = 0; i < endings.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ") + endings[i];
  }
  return text;
}

LinkTree ReadLinkTreeText(const std::string& path, const std::string& text) {
  tinyxml2::XMLDocument xml;
  ParseSafeXml(path, text, &xml);
  const tinyxml2::XMLElement* const root = xml.RootElement();
  const std::string kind = root == nullptr ? "" : std::string(root->Name()).substr(0, 64);
  std::string roots;
  for (const TreeFormat& format : TreeFormats()) {
    if (kind == format.root) {
      LinkTree tree = format.read(path, xml);
      tree.format = format.name;
      FinishTree(&tree);
      return tree;
    }
    roots += (roots.empty() ? "<" : ", <") + std::string(format.root) + "> (" + format.name + ")";
  }
  throw Failure(ExitCode::kUsage, WithoutControls(path + ": the root element is <" + kind + ">, must be " + roots +
                                                  "; run xacro first on a .xacro file"));
}

LinkTree ReadLinkTree(const std::string& path) { return ReadLinkTreeText(path, ReadModelBytes(path)); }

std::string ReadModelBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kMaxXmlBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file.eof() && file.fail()) throw Failure(ExitCode::kUsage, path + ": cannot be read: " + std::strerror(errno));
  text.resize(static_cast<size_t>(file.gcount()));
  return text;
}

}  // namespace rollgait::client
