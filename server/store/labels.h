#ifndef ROLLGAIT_SERVER_STORE_LABELS_H_
#define ROLLGAIT_SERVER_STORE_LABELS_H_

#include <cstdint>
#include <map>
#include <string>

namespace rollgait::server {

// What a solve is found by, keys and values of printable characters; a key has no "=".
using Labels = std::map<std::string, std::string>;

// "key=value" a line, in the order of the keys, without a last line end. Empty: no labels.
std::string JoinLabels(const Labels& labels);
// The labels of such lines, in whatever order they are.
Labels SplitLabels(const std::string& lines);

// What they take in a store.
int64_t BytesOf(const Labels& labels);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_LABELS_H_
