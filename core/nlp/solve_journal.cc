#include "core/nlp/solve_journal.h"

#include <utility>

#include "core/nlp/solve_nlp.h"

namespace rollgait {

// Records the states of one program.
class SolveJournal::Keeper : public StateKeeper {
 public:
  Keeper(const SolveJournal& journal, int program, const NlpFingerprint& fingerprint, int first_iteration)
      : journal_(journal), program_(program), last_iteration_(first_iteration), started_{fingerprint, {}} {}

  bool IsDue(int iteration) override {
    if (!journal_.sink_.started || iteration <= last_iteration_) return false;
    return iteration >= last_iteration_ + journal_.pace_.iterations ||
           std::chrono::duration<double>(Clock::now() - last_time_).count() >= journal_.pace_.seconds;
  }
  void Keep(const InteriorPointState& state) override {
    if (!journal_.sink_.started) return;
    started_.state = state;
    journal_.sink_.started(program_, Encode(started_));
    last_iteration_ = state.iteration;
    last_time_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  const SolveJournal& journal_;
  const int program_;
  int last_iteration_;
  Clock::time_point last_time_ = Clock::now();
  StartedProgram started_;
};

SolveJournal::SolveJournal(JournalRecords past, Sink sink, const Pace& pace)
    : past_(std::move(past)), sink_(std::move(sink)), pace_(pace) {}

void SolveJournal::Ignore(int program, const std::string& why) {
  continuation_.ignored = "the record of program " + std::to_string(program) + " " + why;
  past_ = {};
}

std::optional<NlpResult> SolveJournal::FromRecord(int program, const NlpFingerprint& fingerprint) {
  if (program >= static_cast<int>(past_.finished.size())) return std::nullopt;
  FinishedProgram record;
  if (!Decode(past_.finished[program], &record)) {
    Ignore(program, "is damaged or of another version");
    return std::nullopt;
  }
  const NlpResult& result = record.result;
  const auto has_size = [](const VectorX& part, int64_t size) { return part.size() == 0 || part.size() == size; };
  if (!IsSame(record.fingerprint, fingerprint) || !has_size(result.x, fingerprint.sizes[0]) ||
      !has_size(result.constraint_multipliers, fingerprint.sizes[1]) ||
      !has_size(result.lower_bound_multipliers, fingerprint.sizes[0]) ||
      !has_size(result.upper_bound_multipliers, fingerprint.sizes[0])) {
    Ignore(program, "is of another program than the one that is to be solved");
    return std::nullopt;
  }
  past_.finished[program].clear();  // its memory is of use to the solve
  earlier_s_ += result.wall_time_s;
  continuation_.programs = program + 1;
  return std::move(record.result);
}

std::optional<InteriorPointState> SolveJournal::StateFor(int program, const NlpFingerprint& fingerprint,
                                                         NlpProblem& problem, const NlpOptions& options) {
  if (program != static_cast<int>(past_.finished.size()) || past_.started.empty()) return std::nullopt;
  StartedProgram record;
  if (!Decode(past_.started, &record)) {
    Ignore(program, "is damaged or of another version");
  } else if (!IsSame(record.fingerprint, fingerprint) || !Fits(record.state, problem, options)) {
    Ignore(program, "is of another program than the one that is to be solved");
  } else {
    continuation_.iteration = record.state.iteration;
    past_.started.clear();
    return std::move(record.state);
  }
  return std::nullopt;
}

NlpResult SolveJournal::Solve(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                              const SolveControl& control) {
  const int program = programs_++;
  const NlpFingerprint fingerprint = FingerprintOf(problem, start, options);
  if (std::optional<NlpResult> known = FromRecord(program, fingerprint)) return std::move(*known);
  const std::optional<InteriorPointState> state = StateFor(program, fingerprint, problem, options);
  past_ = {};
  if (control.stop != nullptr && control.stop->requested()) {
    // What a search asks for on its way out is no part of it: nothing is reported or recorded.
    SolveControl silent = control;
    silent.observer = nullptr;
    return SolveNlp(problem, start, options, silent);
  }
  if (!std::exchange(continued_, true) && sink_.continued) sink_.continued(continuation_);
  Keeper keeper(*this, program, fingerprint, state ? state->iteration : 0);
  NlpResult result = SolveNlp(problem, start, options, control, {state ? &*state : nullptr, &keeper});
  if (state) earlier_s_ += state->elapsed_s;
  if (result.termination != Termination::kCancelled && sink_.finished) {
    sink_.finished(program, Encode(FinishedProgram{fingerprint, result}));
  }
  return result;
}

}  // namespace rollgait
