#include "client/import/xml_guard.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "client/failure.h"

namespace rollgait::client {
namespace {

// The place behind the next `end`, or the end of the text.
size_t BehindNext(const std::string& text, const char* end, size_t from) {
  const size_t found = text.find(end, from);
  return found == std::string::npos ? text.size() : found + std::strlen(end);
}

struct Excess {
  size_t place;  // of the tag
  std::string reason;
};

// The first tag with more attributes, or within more elements, than are accepted. Attributes are counted by their
// quotes; a start tag opens an element unless it ends with "/>".
std::optional<Excess> FindExcess(const std::string& text) {
  int depth = 0;
  for (size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = BehindNext(text, "-->", at + 4);
    } else if (text.compare(at, 9, "<![CDATA[") == 0) {
      at = BehindNext(text, "]]>", at + 9);
    } else if (text.compare(at, 2, "<?") == 0) {
      at = BehindNext(text, "?>", at + 2);
    } else {
      const size_t start = at;
      const bool ends = text.compare(at, 2, "</") == 0;
      size_t attributes = 0;
      while (++at < text.size() && text[at] != '>') {
        if (text[at] != '"' && text[at] != '\'') continue;
        at = std::min(text.find(text[at], at + 1), text.size());
        if (++attributes > kMaxXmlAttributes) {
          return Excess{start, "a tag has more than " + std::to_string(kMaxXmlAttributes) + " attributes"};
        }
      }
      if (ends) {
        depth = std::max(0, depth - 1);
      } else if (text[std::min(at, text.size()) - 1] != '/' && ++depth > kMaxXmlDepth) {
        return Excess{start, "elements are nested deeper than " + std::to_string(kMaxXmlDepth)};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

void RequireSafeXml(const std::string& path, const std::string& text) {
  const auto refuse = [&](const std::string& reason) { throw Failure(ExitCode::kUsage, path + ": " + reason); };
  if (text.size() > kMaxXmlBytes) {
    refuse("has more than " + std::to_string(kMaxXmlBytes >> 20) +
           " MiB, which no model needs; meshes are files of their own");
  }
  if (text.find('\0') != std::string::npos) refuse("holds a zero byte; a model is text in UTF-8");
  const size_t tags = static_cast<size_t>(std::count(text.begin(), text.end(), '<'));
  if (tags > kMaxXmlTags) {
    refuse("has " + std::to_string(tags) + " tags; at most " + std::to_string(kMaxXmlTags) + " are accepted");
  }
  const auto line_of = [&](size_t at) {
    return path + ":" +
           std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  };
  for (size_t at = text.find("<!"); at != std::string::npos; at = text.find("<!", at + 1)) {
    if (text.compare(at, 4, "<!--") == 0 || text.compare(at, 9, "<![CDATA[") == 0) continue;
    throw Failure(ExitCode::kUsage,
                  line_of(at) + ": has a document type or entity declaration; a model needs none, remove it");
  }
  if (const std::optional<Excess> excess = FindExcess(text)) {
    throw Failure(ExitCode::kUsage, line_of(excess->place) + ": " + excess->reason);
  }
}

void ParseSafeXml(const std::string& path, const std::string& text, tinyxml2::XMLDocument* xml) {
  RequireSafeXml(path, text);
  if (xml->Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) return;
  throw Failure(ExitCode::kUsage, path + ":" + std::to_string(xml->ErrorLineNum()) +
                                      ": is no XML: " + tinyxml2::XMLDocument::ErrorIDToName(xml->ErrorID()));
}

}  // namespace rollgait::client
