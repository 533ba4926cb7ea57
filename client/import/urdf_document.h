// A URDF file as text that is safe to hand to urdfdom: checked, and reduced to what a model needs.
#ifndef ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_
#define ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_

#include <string>
#include <vector>

namespace tinyxml2 {
class XMLDocument;
}

namespace rollgait::client {

struct UrdfDocument {
  std::string path;                 // as given, for messages
  std::string robot;                // name of the robot
  std::vector<std::string> joints;  // names in the order of the file
  std::vector<std::string> links;
  // Links with inertial and collision (boxes, spheres, cylinders), joints with origin, axis, parent, child, limit and
  // mimic; numbers separated by single spaces; nothing else.
  std::string xml;
  std::vector<std::string> left_out;  // what was in the file and is not in `xml`, a sentence each
};

// Checks a file; `path` is for messages. Opens no file and no address that it names. Throws Failure(kUsage)
// with file, element and reason for: no <robot>; names that are missing, doubled, overlong
// (256 bytes), no UTF-8 or hold control characters; unknown parents and children, links with two parents, cycles,
// several roots; joints without limits that need them; numbers that are missing, no numbers, not finite or beyond
// kMaxXmlNumber.
UrdfDocument CheckUrdf(const std::string& path, const tinyxml2::XMLDocument& xml);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_
