// Values of elements of a file that is not trusted, and refusals that say where they stand.
#ifndef ROLLGAIT_CLIENT_IMPORT_XML_SOURCE_H_
#define ROLLGAIT_CLIENT_IMPORT_XML_SOURCE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}

namespace rollgait::client {

constexpr size_t kMaxXmlName = 256;  // bytes
// The largest number that may stand in a file, in its unit.
constexpr double kMaxXmlNumber = 1e9;

// Numbers as the file has them, and with one space between.
struct XmlNumbers {
  std::vector<double> values;
  std::string text;
};

class XmlSource {
 public:
  explicit XmlSource(std::string path) : path_(std::move(path)) {}
  const std::string& path() const { return path_; }

  // "FILE:LINE: <joint name="knee">", or with the nearest element around it that has a name.
  std::string Where(const tinyxml2::XMLElement& element) const;
  // Throws Failure(kUsage) with that and the reason.
  [[noreturn]] void Refuse(const tinyxml2::XMLElement& element, const std::string& reason) const;

  // What follows refuses as its comment says; `what` is how a refusal names the value.

  // The attribute, which must be there.
  std::string Text(const tinyxml2::XMLElement& element, const char* attribute) const;
  // A name: at most kMaxXmlName bytes of UTF-8 without control characters.
  std::string Name(const tinyxml2::XMLElement& element, const char* attribute = "name") const;
  void RequireName(const tinyxml2::XMLElement& element, const std::string& what, const std::string& name) const;
  // From `least` to `most` numbers, finite and within ±kMaxXmlNumber.
  XmlNumbers Numbers(const tinyxml2::XMLElement& element, const std::string& what, const char* text, size_t least,
                     size_t most) const;
  double Number(const tinyxml2::XMLElement& element, const std::string& what, const char* text) const;
  Eigen::Vector3d Vector(const tinyxml2::XMLElement& element, const std::string& what, const char* text) const;
  // "true" or "false", in any case.
  bool Flag(const tinyxml2::XMLElement& element, const std::string& what, const char* text) const;

  // The child element of a name, which must not stand twice; null if it is neither there nor required.
  const tinyxml2::XMLElement* Only(const tinyxml2::XMLElement& element, const char* child, bool required) const;

 private:
  std::string path_;
};

// What a reader does not use of a file: a line for each kind of element and reason.
class LeftOut {
 public:
  explicit LeftOut(const XmlSource* source) : source_(source) {}
  void Add(const tinyxml2::XMLElement& element, const std::string& reason);
  // "FILE:LINE: <light name="top"> and 3 more: reason", at most 60 lines.
  std::vector<std::string> Lines() const;

 private:
  struct Row {
    std::string kind, where, reason;
    int count = 0;
  };

  const XmlSource* const source_;
  std::vector<Row> rows_;
  int further_ = 0;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_XML_SOURCE_H_
