// Proto3 JSON: lowerCamelCase names are written, both spellings are read, fields at their default are left out.
#ifndef ROLLGAIT_CLIENT_JSON_H_
#define ROLLGAIT_CLIENT_JSON_H_

#include <google/protobuf/message.h>

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// One line without a line feed, or indented lines that end with one.
std::string ToJsonLine(const google::protobuf::Message& message);
std::string ToJsonText(const google::protobuf::Message& message);

// How much a file may have, and why more is none. Parsed, it takes up to about 25 times as much memory.
struct FileLimit {
  int mebibytes;
  const char* reason;
};
inline constexpr FileLimit kRequestFile{64, "which no request has"};  // more than any message that a server takes
inline constexpr FileLimit kModelFile{4, "which no model needs"};

// Reads a proto3 JSON file into `message`; "-" is standard input. Throws Failure(kUsage), with a message of one line,
// if the file is too large, cannot be read, is not JSON, or has a field that the message does not know.
void ReadJsonFile(const std::string& path, google::protobuf::Message& message, const FileLimit& limit = kRequestFile);

// Writes `text` to `path` through a file beside it that is renamed, so that a reader never sees half of it.
// Throws Failure(kInternal) if that fails.
void WriteFile(const std::string& path, const std::string& text);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_JSON_H_
