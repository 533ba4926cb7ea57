#ifndef ROLLGAIT_SERVER_SERVICE_LABEL_CHECK_H_
#define ROLLGAIT_SERVER_SERVICE_LABEL_CHECK_H_

#include <google/protobuf/map.h>

#include <cstddef>
#include <string>

#include "server/base/outcome.h"
#include "server/store/labels.h"

namespace rollgait::server {

inline constexpr size_t kMostLabels = 16;

// The labels of a request, of which it has `most` at most. What is wrong with them joins `violations` under "labels" or
// "labels[\"key\"]", after the prefix.
Labels ReadLabels(const google::protobuf::Map<std::string, std::string>& labels, size_t most, const std::string& prefix,
                  Violations* violations);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_LABEL_CHECK_H_
