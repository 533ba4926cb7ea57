#include "client/repeated_flags.h"

#include <CLI/CLI.hpp>
#include <map>

namespace rollgait::client {

const char kRepeatedFlagsRule[] =
    R"(Flags whose help says "may be repeated" follow one rule:

  * Each time they take one value, and each name once. The name is what stands before = or :, else the whole value. The
    same name a second time is refused: --spring ankle_l=340 --spring ankle_l=300.
  * They are laid over the file of --spec and over --preset name by name. An entry of that name is replaced as a whole
    (--load: every load on that segment), or of a --cost its weight, and is added where there is none. Entries of other
    names stay as they are.
  * --preset is another cost than that of the file: it replaces the preset and every cost of the file; a --cost beside it
    is then added.

Other flags are given once and replace what the file says.
)";

std::string NameOf(const std::string& value) { return value.substr(0, value.find_first_of("=:")); }

CLI::Option* AddRepeatedFlag(CLI::App& command, const std::string& flag, std::vector<std::string>& values,
                             const std::string& help, const std::string& what) {
  const auto take = [&values, flag, what](const std::vector<std::string>& given) {
    std::map<std::string, std::string> seen;
    for (const std::string& value : given) {
      const auto [before, is_new] = seen.emplace(NameOf(value), value);
      if (is_new) continue;
      throw CLI::ValidationError(flag + " " + before->second + " and " + flag + " " + value,
                                 "say two things of the same " + what + "; give one of them");
    }
    values = given;
  };
  return command
      .add_option_function<std::vector<std::string>>(flag, take, help + "; may be repeated, once for each " + what)
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace rollgait::client
