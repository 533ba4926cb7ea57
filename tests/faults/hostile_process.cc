#include "tests/faults/hostile_process.h"

#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace rollgait::faults {
namespace {

constexpr int64_t kNumbersOfAnAttack = 100'000;

}  // namespace

HostileProcess::HostileProcess(const std::string& address, const std::string& token_file, const std::string& solve,
                               const std::string& only)
    : command_("exec chrt --idle 0 " HOSTILE_TENANT " --to " + address + " --token " + token_file + " --solve " +
               solve + (only.empty() ? "" : " --only '" + only + "'")) {}

void HostileProcess::Attack(double seconds) {
  const std::string command = command_ + " --seconds " + std::to_string(seconds) + " --first-number " +
                              std::to_string(kNumbersOfAnAttack * attacks_++);
  FILE* const output = popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error("the hostile tenant cannot be started");
  char line[512];
  while (std::fgets(line, sizeof line, output) != nullptr) {
    std::istringstream text(line);
    std::string name;
    Tally tally;
    if (!std::getline(text, name, '\t') || !(text >> tally.served >> tally.refused)) continue;
    tallies_[name].served += tally.served;
    tallies_[name].refused += tally.refused;
  }
  if (pclose(output) != 0) throw std::runtime_error("the hostile tenant failed");
}

}  // namespace rollgait::faults
