#include "client/settings.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <vector>

#include "client/failure.h"
#include "core/base/nearest_word.h"

namespace rollgait::client {
namespace {

// The flags that have a variable and a key, by key.
std::map<std::string, CLI::Option*> SettableFlags(CLI::App& app) {
  std::map<std::string, CLI::Option*> flags;
  for (CLI::Option* option : app.get_options([](CLI::Option*) { return true; })) {
    if (option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    if (name != "help" && name != "version") flags[name] = option;
  }
  return flags;
}

// The keys and values of the file. Throws Failure as ApplySettings.
std::map<std::string, std::string> ReadConfiguration(const ConfigurationFile& file) {
  if (file.path.empty()) return {};
  std::ifstream stream(file.path);
  if (!stream) {
    if (!file.required) return {};
    throw Failure(ExitCode::kUsage, "ROLLGAIT_CONFIG=" + file.path + ": cannot be read: " + std::strerror(errno));
  }
  std::map<std::string, std::string> values;
  try {
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(stream)) {
      if (!item.parents.empty()) {
        throw Failure(ExitCode::kUsage, file.path + ": [" + item.parents.front() +
                                            "]: there are no sections; the file has the flags of every command only");
      }
      if (item.inputs.size() != 1) throw Failure(ExitCode::kUsage, file.path + ": " + item.name + ": give one value");
      values[item.name] = item.inputs.front();
    }
  } catch (const CLI::Error& error) {
    throw Failure(ExitCode::kUsage, file.path + ": is not TOML: " + error.what());
  }
  return values;
}

// `source`: "ROLLGAIT_TIMEOUT" or "config.toml: timeout".
void SetDefault(CLI::Option& option, const std::string& source, const std::string& value) {
  try {
    option.run_callback_for_default();  // of flags such as --quiet Debian 13's CLI11 does so only when asked
    option.default_val(value);
  } catch (const CLI::Error& error) {
    throw Failure(ExitCode::kUsage, source + " = " + value + ": is not a value of --" + option.get_lnames().front() +
                                        ": " + error.what());
  }
}

}  // namespace

Environment ProcessEnvironment() {
  return [](const std::string& name) -> std::optional<std::string> {
    const char* const value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  };
}

std::string VariableOf(const std::string& flag) {
  std::string name = "ROLLGAIT_";
  for (const char letter : flag.substr(flag.find_first_not_of('-'))) {
    name += letter == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return name;
}

ConfigurationFile FindConfiguration(const Environment& environment) {
  if (const std::optional<std::string> named = environment("ROLLGAIT_CONFIG")) return {*named, !named->empty()};
  const std::string folder = environment("XDG_CONFIG_HOME").value_or("");
  if (!folder.empty()) return {folder + "/rollgait/config.toml", false};
  const std::string home = environment("HOME").value_or("");
  return {home.empty() ? "" : home + "/.config/rollgait/config.toml", false};
}

void ApplySettings(CLI::App& app, const Environment& environment) {
  const std::map<std::string, CLI::Option*> flags = SettableFlags(app);
  const ConfigurationFile file = FindConfiguration(environment);
  std::vector<std::string> keys;
  for (const auto& [key, option] : flags) keys.push_back(key);
  for (const auto& [key, value] : ReadConfiguration(file)) {
    const auto flag = flags.find(key);
    if (flag == flags.end()) {
      throw Failure(ExitCode::kUsage, file.path + ": " + key + ": no such setting" + DidYouMean(key, keys) +
                                          "\n`rollgait help settings` says which there are.");
    }
    SetDefault(*flag->second, file.path + ": " + key, value);
  }
  for (const auto& [key, option] : flags) {
    const std::string variable = VariableOf(key);
    const std::string value = environment(variable).value_or("");
    if (!value.empty()) SetDefault(*option, variable, value);
  }
}

}  // namespace rollgait::client
