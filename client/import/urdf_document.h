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
// with file, line, element and reason for: a text that exceeds a bound; no XML; a document type declaration, which
// could define entities; elements nested deeper than 100; no <robot>; missing, doubled or overlong names (256 bytes);
// unknown parents and children, links with two parents, cycles, several roots; joints without limits that need them;
// numbers that are missing, no numbers, not finite or beyond kMaxUrdfNumber.
UrdfDocument CheckUrdfText(const std::string& path, const std::string& text);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_URDF_DOCUMENT_H_
