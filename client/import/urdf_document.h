// A URDF file as text that is safe to hand to a parser: bounded in size, checked, and reduced to what a model needs.
#ifndef ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_
#define ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_

#include <string>
#include <vector>

namespace rollgait::client {

// Bounds of a file: together they keep the memory that reading takes below 150 MB.
constexpr size_t kMaxUrdfBytes = size_t{4} << 20;
constexpr size_t kMaxUrdfTags = 100000;    // start and end tags, comments
constexpr size_t kMaxUrdfAttributes = 64;  // of a tag; parsers take a time that grows with their square
constexpr size_t kMaxUrdfLinks = 1000;     // and as many joints
// Elements within each other, the root included. Below the limit of every version of the parser.
constexpr int kMaxUrdfDepth = 64;
// The largest number that any attribute may have, in its unit.
constexpr double kMaxUrdfNumber = 1e9;

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

// The content of a file, or its first kMaxUrdfBytes + 1 bytes. Throws Failure(kUsage) if it cannot be read.
std::string ReadUrdfBytes(const std::string& path);

// Checks the text of a file; `path` is for messages. Opens no file and no address that it names. Throws Failure(kUsage)
// with file, element and reason, and the line where the text itself is wrong, for: a text that exceeds a bound; no XML;
// a document type declaration, which could define entities; no <robot>; names that are missing, doubled, overlong
// (256 bytes), no UTF-8 or hold control characters; unknown parents and children, links with two parents, cycles,
// several roots; joints without limits that need them; numbers that are missing, no numbers, not finite or beyond
// kMaxUrdfNumber.
UrdfDocument CheckUrdfText(const std::string& path, const std::string& text);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_
