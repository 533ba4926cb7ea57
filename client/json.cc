#include "client/json.h"

#include <google/protobuf/util/json_util.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "client/failure.h"

namespace rollgait::client {
namespace {

std::string Print(const google::protobuf::Message& message, bool indented) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = indented;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) throw Failure(ExitCode::kInternal, "cannot write JSON: " + status.ToString());
  return text;
}

// Each run of spaces and line feeds as one space.
std::string OneLine(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

}  // namespace

std::string ToJsonLine(const google::protobuf::Message& message) { return Print(message, false); }

std::string ToJsonText(const google::protobuf::Message& message) { return Print(message, true); }

void ReadJsonFile(const std::string& given, google::protobuf::Message& message, const FileLimit& limit) {
  const bool is_input = given == "-";
  const std::string path = is_input ? "standard input" : given;
  std::ifstream file(is_input ? "/dev/stdin" : given, std::ios::binary);
  const size_t most = static_cast<size_t>(limit.mebibytes) << 20;
  std::string text(1 << 16, '\0');
  size_t size = 0;
  while (file.read(text.data() + size, static_cast<std::streamsize>(text.size() - size)).gcount() > 0) {
    size += static_cast<size_t>(file.gcount());
    if (size > most) {
      throw Failure(ExitCode::kUsage,
                    path + ": has more than " + std::to_string(limit.mebibytes) + " MiB, " + limit.reason);
    }
    if (size == text.size()) text.resize(std::min(2 * size, most + 1));
  }
  if (!file.eof()) throw Failure(ExitCode::kUsage, path + ": cannot be read: " + std::strerror(errno));
  text.resize(size);
  const auto status = google::protobuf::util::JsonStringToMessage(text, &message);
  if (!status.ok()) {
    throw Failure(ExitCode::kUsage, path + ": not a proto3 JSON " + message.GetDescriptor()->full_name() + ": " +
                                        OneLine(std::string(status.message())));
  }
}

void WriteFile(const std::string& path, const std::string& text) {
  // A pipe or a device cannot be replaced by a file; it is written as it is.
  std::error_code ignored;
  const bool special = std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
  const std::string temporary = special ? path : path + ".part-" + std::to_string(getpid());
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file || (!special && std::rename(temporary.c_str(), path.c_str()) != 0)) {
    const std::string reason = std::strerror(errno);
    if (!special) std::remove(temporary.c_str());
    throw Failure(ExitCode::kInternal, path + ": cannot be written: " + reason);
  }
}

}  // namespace rollgait::client
