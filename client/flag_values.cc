#include "client/flag_values.h"

#include <sstream>
#include <stdexcept>

namespace rollgait::client {

std::pair<std::string, double> ParseAssignment(const std::string& flag, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals != std::string::npos && equals > 0) {
    try {
      size_t used = 0;
      const std::string number = text.substr(equals + 1);
      const double value = std::stod(number, &used);
      if (used == number.size()) return {text.substr(0, equals), value};
    } catch (const std::logic_error&) {
      // Not a number; said below.
    }
  }
  throw Failure(ExitCode::kUsage, flag + " " + text + ": must be NAME=NUMBER");
}

std::pair<std::string, std::string> ParseLabel(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals != std::string::npos && equals > 0) return {text.substr(0, equals), text.substr(equals + 1)};
  throw Failure(ExitCode::kUsage, "--label " + text + ": must be KEY=VALUE, for example --label sweep=hills");
}

std::vector<double> ParseNumbers(const std::string& flag, const std::string& text, const std::string& form,
                                 const std::vector<size_t>& counts) {
  std::vector<double> numbers;
  bool good = true;
  std::istringstream parts(text);
  for (std::string part; good && std::getline(parts, part, ',');) {
    try {
      size_t used = 0;
      numbers.push_back(std::stod(part, &used));
      good = used == part.size();
    } catch (const std::logic_error&) {
      good = false;
    }
  }
  for (const size_t count : counts) {
    if (good && numbers.size() == count && text.back() != ',') return numbers;
  }
  throw Failure(ExitCode::kUsage, flag + (flag.back() == '=' ? "" : " ") + text + ": must be " + form);
}

}  // namespace rollgait::client
