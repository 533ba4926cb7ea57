// Flags that may be repeated: one rule for all of them.
#ifndef ROLLGAIT_CLIENT_REPEATED_FLAGS_H_
#define ROLLGAIT_CLIENT_REPEATED_FLAGS_H_

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rollgait::client {

// The rule, as `rollgait help repeated-flags` prints it; lines end with a line feed.
extern const char kRepeatedFlagsRule[];

// What a value of a flag that may be repeated is about: "knee_l" of "knee_l=20", "work" of "work:0.5", else all of it.
std::string NameOf(const std::string& value);

// Adds a flag that takes one value each time it is given. The help ends with ", once for each `what`". The parse
// refuses (CLI::ValidationError, which quotes both values) a name that was given before.
CLI::Option* AddRepeatedFlag(CLI::App& command, const std::string& flag, std::vector<std::string>& values,
                             const std::string& help, const std::string& what);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPEATED_FLAGS_H_
