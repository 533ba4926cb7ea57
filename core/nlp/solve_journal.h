#ifndef ROLLGAIT_CORE_NLP_SOLVE_JOURNAL_H_
#define ROLLGAIT_CORE_NLP_SOLVE_JOURNAL_H_

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/nlp/journal_codec.h"
#include "core/nlp/nlp_options.h"
#include "core/nlp/problem.h"
#include "core/nlp/result.h"

namespace rollgait {

// What a search that solves one nonlinear program after another leaves behind, so that the same search in another
// process goes on where this one ended: a record of each program that is finished, in order, and one of the program
// under way.
struct JournalRecords {
  std::vector<std::string> finished;
  std::string started;  // of program number finished.size(), from 0; empty: none
};

// How a search goes on from records.
struct Continuation {
  int programs = 0;     // answered from records, without an iteration
  int iteration = 0;    // the one from which the next program goes on; 0: it starts from nothing
  std::string ignored;  // why records were left; empty: there were none left
};

// Solves the programs of one search. The search must ask for the same programs in the same order each time it is run:
// as long as it does (NlpFingerprint), programs that are recorded are answered from their records, and the one that was
// under way goes on from its last state. With the first that does not match, or whose record is torn, the search goes
// on from nothing. One thread.
class SolveJournal {
 public:
  // Where records go, in the thread that solves; any of them may be empty. `program` counts from 0, those of earlier
  // processes included; a record of one takes the place of all that were kept of it and of later ones.
  struct Sink {
    std::function<void(int program, std::string record)> finished;
    std::function<void(int program, std::string record)> started;
    // Once, before the first program that is solved.
    std::function<void(const Continuation&)> continued;
  };
  // A state is recorded `iterations` after the last one, or once `seconds` have passed, and when a solve is stopped.
  struct Pace {
    int iterations = 2;
    double seconds = 0.5;
  };
  SolveJournal(JournalRecords past, Sink sink, const Pace& pace);
  SolveJournal(JournalRecords past, Sink sink) : SolveJournal(std::move(past), std::move(sink), Pace()) {}

  // SolveNlp, for the next program of the search. Once the search is stopped, programs that it still asks for are
  // neither reported nor recorded.
  NlpResult Solve(NlpProblem& problem, const NlpStart& start, const NlpOptions& options, const SolveControl& control);

  // Time, s, that earlier processes have spent on what was answered from their records so far.
  double earlier_s() const { return earlier_s_; }

 private:
  class Keeper;
  std::optional<NlpResult> FromRecord(int program, const NlpFingerprint& fingerprint);
  std::optional<InteriorPointState> StateFor(int program, const NlpFingerprint& fingerprint, NlpProblem& problem,
                                             const NlpOptions& options);
  void Ignore(int program, const std::string& why);

  JournalRecords past_;
  const Sink sink_;
  const Pace pace_;
  int programs_ = 0;
  double earlier_s_ = 0;
  Continuation continuation_;
  bool continued_ = false;  // it has been told
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_SOLVE_JOURNAL_H_
