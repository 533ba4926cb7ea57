// Defaults of the flags of every command: from the environment and the configuration file.
#ifndef ROLLGAIT_CLIENT_SETTINGS_H_
#define ROLLGAIT_CLIENT_SETTINGS_H_

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace rollgait::client {

// The value of an environment variable; nullopt: it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;
Environment ProcessEnvironment();

// ROLLGAIT_TLS_CA for --tls-ca.
std::string VariableOf(const std::string& flag);

// Where the configuration file is: ROLLGAIT_CONFIG, else rollgait/config.toml in XDG_CONFIG_HOME, else in HOME/.config.
struct ConfigurationFile {
  std::string path;       // empty: none
  bool required = false;  // it was named by ROLLGAIT_CONFIG
};
ConfigurationFile FindConfiguration(const Environment& environment);

// Gives the flags of `app` itself, not those of its commands, the values of their variables and, where there is none,
// those of the file, so that a flag on the command line still wins. --help and --version have neither. Throws
// Failure(kUsage) that names variable or file, key and value: for a value that the flag refuses, a key that is no flag,
// a file that is not TOML, and a file named by ROLLGAIT_CONFIG that cannot be read.
void ApplySettings(CLI::App& app, const Environment& environment);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SETTINGS_H_
