#include "client/spec_words.h"

#include "client/bound_flags.h"
#include "client/formats/format_table.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// The fields of CostTerm.term that have a word, in the order of the proto.
std::vector<const google::protobuf::FieldDescriptor*> WordedCosts() {
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  const google::protobuf::OneofDescriptor* term = v1::CostTerm::descriptor()->FindOneofByName("term");
  for (int i = 0; i < term->field_count(); ++i) {
    if (!term->field(i)->options().GetExtension(v1::cost_word).empty()) fields.push_back(term->field(i));
  }
  return fields;
}

template <typename Value>
std::vector<std::string> Keys(const WordTable<Value>& words) {
  std::vector<std::string> keys;
  for (const auto& [word, value] : words) keys.push_back(word);
  return keys;
}

// "time limit" as one word of a command line: "time-limit".
std::string OneWord(std::string name) {
  for (char& letter : name) {
    if (letter == ' ') letter = '-';
  }
  return name;
}

std::vector<std::string> FormatWords() {
  std::vector<std::string> words;
  for (const Format& format : Formats()) words.push_back(format.name);
  return words;
}

}  // namespace

const WordTable<v1::ModelSelection::Sex>& SexWords() {
  static const WordTable<v1::ModelSelection::Sex> words = {{"female", v1::ModelSelection::SEX_FEMALE},
                                                           {"male", v1::ModelSelection::SEX_MALE}};
  return words;
}

const WordTable<v1::ModelSelection::Feet>& FeetWords() {
  static const WordTable<v1::ModelSelection::Feet> words = {{"one", v1::ModelSelection::FEET_ONE_ELLIPSOID},
                                                            {"two", v1::ModelSelection::FEET_TWO_ELLIPSOIDS}};
  return words;
}

const WordTable<v1::ModelSelection::Ranges>& RangesWords() {
  static const WordTable<v1::ModelSelection::Ranges> words = {{"anatomical", v1::ModelSelection::RANGES_ANATOMICAL},
                                                              {"walking", v1::ModelSelection::RANGES_WALKING}};
  return words;
}

const WordTable<v1::Cycle>& CycleWords() {
  static const WordTable<v1::Cycle> words = {{"half", v1::CYCLE_HALF}, {"full", v1::CYCLE_FULL}};
  return words;
}

const WordTable<v1::TouchDown>& TouchDownWords() {
  static const WordTable<v1::TouchDown> words = {{"smooth", v1::TOUCH_DOWN_SMOOTH},
                                                 {"plastic", v1::TOUCH_DOWN_PLASTIC}};
  return words;
}

const WordTable<v1::Preset>& PresetWords() {
  static const WordTable<v1::Preset> words = {
      {"torque", v1::PRESET_TORQUE}, {"transport", v1::PRESET_TRANSPORT}, {"human", v1::PRESET_HUMAN}};
  return words;
}

const WordTable<v1::CostNormalization>& NormalizationWords() {
  static const WordTable<v1::CostNormalization> words = {{"distance", v1::COST_NORMALIZATION_PER_DISTANCE},
                                                         {"time", v1::COST_NORMALIZATION_PER_TIME},
                                                         {"none", v1::COST_NORMALIZATION_NONE}};
  return words;
}

const WordTable<v1::Discretization::Scheme>& SchemeWords() {
  static const auto words = [] {
    WordTable<v1::Discretization::Scheme> table;
    const auto* schemes = v1::Discretization::Scheme_descriptor();
    for (int i = 1; i < schemes->value_count(); ++i) {  // the first is "unspecified"
      std::string word = schemes->value(i)->name().substr(std::string("SCHEME_").size());
      for (char& c : word) c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      table[word] = static_cast<v1::Discretization::Scheme>(schemes->value(i)->number());
    }
    return table;
  }();
  return words;
}

const WordTable<v1::NlpSolver>& SolverWords() {
  static const WordTable<v1::NlpSolver> words = {{"interior-point", v1::NLP_SOLVER_INTERIOR_POINT},
                                                 {"ipopt", v1::NLP_SOLVER_IPOPT}};
  return words;
}

const WordTable<v1::Accuracy::Level>& AccuracyWords() {
  static const WordTable<v1::Accuracy::Level> words = {{"draft", v1::Accuracy::LEVEL_DRAFT},
                                                       {"standard", v1::Accuracy::LEVEL_STANDARD},
                                                       {"fine", v1::Accuracy::LEVEL_FINE}};
  return words;
}

const WordTable<v1::CostTerm>& CostWords() {
  static const WordTable<v1::CostTerm> words = [] {
    WordTable<v1::CostTerm> all;
    for (const google::protobuf::FieldDescriptor* field : WordedCosts()) {
      v1::CostTerm& term = all[field->options().GetExtension(v1::cost_word)];
      term.GetReflection()->MutableMessage(&term, field);
    }
    return all;
  }();
  return words;
}

std::string CostWordList() {
  std::string list;
  const std::vector<const google::protobuf::FieldDescriptor*> fields = WordedCosts();
  for (size_t i = 0; i < fields.size(); ++i) {
    list += (i == 0 ? "" : i + 1 < fields.size() ? ", " : " or ") + fields[i]->options().GetExtension(v1::cost_word);
  }
  return list;
}

const WordTable<v1::SolveState>& StateWords() {
  static const WordTable<v1::SolveState> words = [] {
    WordTable<v1::SolveState> all;
    for (const v1::SolveState state : {v1::SOLVE_STATE_QUEUED, v1::SOLVE_STATE_RUNNING, v1::SOLVE_STATE_SUCCEEDED,
                                       v1::SOLVE_STATE_FAILED, v1::SOLVE_STATE_CANCELLED}) {
      all[StateName(state)] = state;
    }
    return all;
  }();
  return words;
}

const WordTable<v1::Verdict>& VerdictWords() {
  static const WordTable<v1::Verdict> words = {{"none", v1::VERDICT_UNSPECIFIED},
                                               {"within", v1::VERDICT_WITHIN},
                                               {"exceeded", v1::VERDICT_EXCEEDED},
                                               {"not-judged", v1::VERDICT_NOT_JUDGED}};
  return words;
}

const WordTable<v1::Termination>& TerminationWords() {
  static const WordTable<v1::Termination> words = [] {
    WordTable<v1::Termination> all = {{"none", v1::TERMINATION_UNSPECIFIED}};
    for (int value = v1::Termination_MIN + 1; value <= v1::Termination_MAX; ++value) {
      const auto termination = static_cast<v1::Termination>(value);
      if (v1::Termination_IsValid(value)) all[OneWord(TerminationName(termination))] = termination;
    }
    return all;
  }();
  return words;
}

std::vector<std::string> FlagWords(const std::string& flag) {
  if (flag == "--sex") return Keys(SexWords());
  if (flag == "--feet") return Keys(FeetWords());
  if (flag == "--ranges") return Keys(RangesWords());
  if (flag == "--cycle") return Keys(CycleWords());
  if (flag == "--touch-down") return Keys(TouchDownWords());
  if (flag == "--preset") return Keys(PresetWords());
  if (flag == "--cost") return Keys(CostWords());
  if (flag == "--normalize") return Keys(NormalizationWords());
  if (flag == "--scheme") return Keys(SchemeWords());
  if (flag == "--solver") return Keys(SolverWords());
  if (flag == "--accuracy") return Keys(AccuracyWords());
  if (flag == "--bound") return BoundNames();
  if (flag == "--format") return FormatWords();
  if (flag == "--state") return Keys(StateWords());
  if (flag == "--verdict") return Keys(VerdictWords());
  if (flag == "--termination") return Keys(TerminationWords());
  return {};
}

}  // namespace rollgait::client
