// Values of flags that are more than a number.
#ifndef ROLLGAIT_CLIENT_FLAG_VALUES_H_
#define ROLLGAIT_CLIENT_FLAG_VALUES_H_

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "core/base/nearest_word.h"

namespace rollgait::client {

// The value that the word stands for. Throws Failure(kUsage), which lists the known words and names the one that may
// have been meant, for another word.
template <typename Value>
Value Lookup(const std::string& flag, const std::string& word, const std::map<std::string, Value>& words) {
  const auto found = words.find(word);
  if (found != words.end()) return found->second;
  std::string known;
  std::vector<std::string> candidates;
  for (const auto& [name, value] : words) {
    known += (known.empty() ? "" : ", ") + name;
    candidates.push_back(name);
  }
  throw Failure(ExitCode::kUsage, flag + " " + word + ": must be one of " + known + DidYouMean(word, candidates));
}

// Of "NAME=NUMBER". Throws Failure(kUsage) for another text.
std::pair<std::string, double> ParseAssignment(const std::string& flag, const std::string& text);

// Of "KEY=VALUE". What keys and values may be is the server's to check. Throws Failure(kUsage) for another text.
std::pair<std::string, std::string> ParseLabel(const std::string& text);

// Of "1,-2.5": numbers separated by commas, as many as one of `counts`. Throws Failure(kUsage), which says that the
// text must be `form`.
//   flag  "--from", or with the name before the numbers "--spring ankle_l="
std::vector<double> ParseNumbers(const std::string& flag, const std::string& text, const std::string& form,
                                 const std::vector<size_t>& counts);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FLAG_VALUES_H_
