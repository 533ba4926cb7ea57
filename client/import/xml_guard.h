// What an XML parser must not be given.
#ifndef ROLLGAIT_CLIENT_IMPORT_XML_GUARD_H_
#define ROLLGAIT_CLIENT_IMPORT_XML_GUARD_H_

#include <string>

namespace tinyxml2 {
class XMLDocument;
}

namespace rollgait::client {

// Bounds of a file: together they keep the memory that reading takes below 150 MB.
constexpr size_t kMaxXmlBytes = size_t{4} << 20;
constexpr size_t kMaxXmlTags = 100000;    // start and end tags, comments
constexpr size_t kMaxXmlAttributes = 64;  // of a tag; parsers take a time that grows with their square
// Elements within each other, the root included. Below the limit of every version of the parser.
constexpr int kMaxXmlDepth = 64;

// Throws Failure(kUsage) with path, line and reason for a text that exceeds a bound, holds a zero byte, or declares a
// document type or entities. Takes a time that grows with the size of the text.
void RequireSafeXml(const std::string& path, const std::string& text);

// The same, and parses it. Throws Failure(kUsage) with path, line and reason also for what is no XML.
void ParseSafeXml(const std::string& path, const std::string& text, tinyxml2::XMLDocument* xml);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_XML_GUARD_H_
