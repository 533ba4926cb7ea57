// The words of flags that take one of a few: the one table for reading them, for completion and for the man page.
#ifndef ROLLGAIT_CLIENT_SPEC_WORDS_H_
#define ROLLGAIT_CLIENT_SPEC_WORDS_H_

#include <map>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

template <typename Value>
using WordTable = std::map<std::string, Value>;

const WordTable<v1::ModelSelection::Sex>& SexWords();
const WordTable<v1::ModelSelection::Feet>& FeetWords();
const WordTable<v1::ModelSelection::Ranges>& RangesWords();
const WordTable<v1::Cycle>& CycleWords();
const WordTable<v1::TouchDown>& TouchDownWords();
const WordTable<v1::Preset>& PresetWords();
const WordTable<v1::CostNormalization>& NormalizationWords();
const WordTable<v1::Discretization::Scheme>& SchemeWords();
const WordTable<v1::NlpSolver>& SolverWords();
const WordTable<v1::Accuracy::Level>& AccuracyWords();
// Terms without weight or parameters, by the option cost_word of their fields.
const WordTable<v1::CostTerm>& CostWords();
// "torque, time or work", in the order of the proto.
std::string CostWordList();
// "a, b, c": all words of a table.
template <typename Value>
std::string Listed(const WordTable<Value>& words) {
  std::string list;
  for (const auto& [word, value] : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}
const WordTable<v1::SolveState>& StateWords();
// Also "none": no verdict yet, no termination yet.
const WordTable<v1::Verdict>& VerdictWords();
const WordTable<v1::Termination>& TerminationWords();

// The words that the value of a flag ("--scheme") begins with, sorted; empty: it takes no words.
std::vector<std::string> FlagWords(const std::string& flag);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SPEC_WORDS_H_
