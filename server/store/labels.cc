#include "server/store/labels.h"

#include <algorithm>

#include "core/base/check.h"

namespace rollgait::server {

std::string JoinLabels(const Labels& labels) {
  std::string lines;
  for (const auto& [key, value] : labels) lines += (lines.empty() ? "" : "\n") + key + "=" + value;
  return lines;
}

Labels SplitLabels(const std::string& lines) {
  Labels labels;
  for (size_t start = 0; start < lines.size();) {
    const size_t end = std::min(lines.find('\n', start), lines.size());
    const size_t equals = lines.find('=', start);
    ROLLGAIT_CHECK(equals < end);
    labels[lines.substr(start, equals - start)] = lines.substr(equals + 1, end - equals - 1);
    start = end + 1;
  }
  return labels;
}

int64_t BytesOf(const Labels& labels) {
  size_t bytes = 0;
  for (const auto& [key, value] : labels) bytes += key.size() + value.size();
  return static_cast<int64_t>(bytes);
}

}  // namespace rollgait::server
