// What an XML parser must not be given.
#ifndef ROLLGAIT_CLIENT_IMPORT_XML_GUARD_H_
#define ROLLGAIT_CLIENT_IMPORT_XML_GUARD_H_

#include <string>

namespace rollgait::client {

// Throws Failure(kUsage) with path, line and reason for a text that exceeds kMaxUrdfBytes, kMaxUrdfTags,
// kMaxUrdfAttributes or kMaxUrdfDepth (urdf_document.h), holds a zero byte, or declares a document type or entities.
// Takes a time that grows with the size of the text.
void RequireSafeXml(const std::string& path, const std::string& text);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_XML_GUARD_H_
