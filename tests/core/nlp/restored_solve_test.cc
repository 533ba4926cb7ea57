// Solves that go through restoration: iterations, limits, states.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/nlp/interior_point.h"
#include "core/nlp/journal_codec.h"
#include "tests/core/nlp/hs071.h"
#include "tests/core/nlp/suite/chain_program.h"
#include "tests/core/nlp/suite/measure.h"

namespace rollgait {
namespace {

// Problem 65 of Hock and Schittkowski goes through restoration and ends at its solution.
class Restored : public ::testing::Test {
 protected:
  static suite::SuiteRow Row() {
    for (const suite::SuiteRow& row : suite::HockSchittkowskiLarge()) {
      if (row.name == "HS65") return row;
    }
    return {};
  }
  InteriorPointResult Solve(const NlpOptions& options, const SolveControl& control,
                            const Resumption& resumption = {}) const {
    const auto program = Row().make();
    return SolveWithInteriorPoint(*program, suite::StartOf(Row()), options, control, resumption);
  }
};

TEST_F(Restored, IterationsAreNumberedThroughAndMarked) {
  std::vector<IterationInfo> seen;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) { seen.push_back(info); };
  const InteriorPointResult out = Solve(suite::SuiteOptions(), control);
  ASSERT_EQ(out.result.termination, Termination::kOptimal) << out.result.message;
  ASSERT_EQ(static_cast<int>(seen.size()), out.result.iterations + 1);
  int restored = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].index, static_cast<int>(i));
    if (!seen[i].restoration) continue;
    ++restored;
    ASSERT_GT(i, 0u);
    EXPECT_LT(seen[i].primal_infeasibility, seen[i - 1].primal_infeasibility);
  }
  EXPECT_GT(restored, 0);
}

TEST_F(Restored, IsStoppedWithinIt) {
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  int last = -1;
  control.observer = [&](const IterationInfo& info) {
    last = info.index;
    if (info.restoration) stop.Request();
  };
  const InteriorPointResult out = Solve(suite::SuiteOptions(), control);
  EXPECT_EQ(out.result.termination, Termination::kCancelled);
  EXPECT_FALSE(out.needs_restoration);
  EXPECT_EQ(out.result.iterations, last);
}

TEST_F(Restored, IsSubjectToTheIterationLimit) {
  int first = -1;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) {
    if (info.restoration && first < 0) first = info.index;
  };
  Solve(suite::SuiteOptions(), control);
  ASSERT_GT(first, 0);
  NlpOptions options = suite::SuiteOptions();
  options.max_iterations = first;
  const InteriorPointResult out = Solve(options, {});
  EXPECT_EQ(out.result.termination, Termination::kIterationLimit);
  EXPECT_EQ(out.result.iterations, first);
  EXPECT_FALSE(out.needs_restoration);
}

struct AllStates : StateKeeper {
  bool IsDue(int) override { return true; }
  void Keep(const InteriorPointState& state) override { states.push_back(state); }
  std::vector<InteriorPointState> states;
};

// The record of a state, read again.
InteriorPointState Reread(const InteriorPointState& state) {
  StartedProgram program;
  EXPECT_TRUE(Decode(Encode(StartedProgram{{}, state}), &program));
  return program.state;
}

// All of a state but its time.
std::string BytesOf(InteriorPointState state) {
  state.elapsed_s = 0;
  return Encode(StartedProgram{{}, std::move(state)});
}

// States from before it, from within and from after it lead to the same states and the same end, to the last bit.
TEST_F(Restored, GoesOnFromAnyState) {
  Hs071 infeasible(3);
  suite::ChainProgram chain({6, 5, 0, 0.1, true, 50});  // its final state is out of reach
  const auto restored = Row().make();
  const std::pair<NlpProblem*, NlpStart> programs[] = {
      {restored.get(), suite::StartOf(Row())},
      {&infeasible, {Hs071::Start(), {}, {}, {}}},
      {&chain, {VectorX::Constant(chain.variables(), 0.1), {}, {}, {}}}};
  for (const auto& [program, from] : programs) {
    AllStates keeper;
    const NlpOptions options = suite::SuiteOptions();
    const NlpResult whole = SolveWithInteriorPoint(*program, from, options, {}, {nullptr, &keeper}).result;
    ASSERT_GT(keeper.states.size(), 3u);
    int within = 0;
    for (const InteriorPointState& kept : keeper.states) {
      const InteriorPointState state = Reread(kept);
      within += state.restoration ? 1 : 0;
      EXPECT_TRUE(Fits(state, *program, options)) << state.iteration;
      AllStates later;
      const NlpResult rest = SolveWithInteriorPoint(*program, from, options, {}, {&state, &later}).result;
      EXPECT_EQ(rest.termination, whole.termination);
      EXPECT_EQ(rest.x, whole.x) << state.iteration;
      EXPECT_EQ(rest.iterations, whole.iterations) << state.iteration;
      EXPECT_EQ(rest.constraint_multipliers, whole.constraint_multipliers) << state.iteration;
      for (const InteriorPointState& next : later.states) {
        const InteriorPointState& known = keeper.states[static_cast<size_t>(next.iteration)];
        EXPECT_EQ(BytesOf(next), BytesOf(known)) << state.iteration << ", " << next.iteration;
      }
    }
    EXPECT_EQ(within > 3, program != restored.get()) << within;
  }
}

// Whoever is stopped within it leaves a state of the iteration that was reported last, and the limits hold for the one
// who goes on.
TEST_F(Restored, LeavesItsStateWhereItIsStopped) {
  struct LastState : AllStates {
    bool IsDue(int) override { return false; }
  } keeper;
  Hs071 program(3);
  const NlpStart start{Hs071::Start(), {}, {}, {}};
  NlpOptions options = suite::SuiteOptions();
  const NlpResult whole = SolveWithInteriorPoint(program, start, options, {}).result;
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  int restored = 0;
  std::vector<int> indices;
  control.observer = [&](const IterationInfo& info) {
    indices.push_back(info.index);
    restored += info.restoration ? 1 : 0;
    if (restored == 2) stop.Request();
  };
  const NlpResult first = SolveWithInteriorPoint(program, start, options, control, {nullptr, &keeper}).result;
  EXPECT_EQ(first.termination, Termination::kCancelled);
  ASSERT_EQ(keeper.states.size(), 1u);
  const InteriorPointState state = keeper.states[0];
  EXPECT_EQ(state.iteration, indices.back());
  ASSERT_TRUE(state.restoration.has_value());
  EXPECT_EQ(state.restoration->w.head(4), first.x);
  control.stop = nullptr;
  const NlpResult second = SolveWithInteriorPoint(program, start, options, control, {&state, nullptr}).result;
  EXPECT_EQ(second.termination, Termination::kInfeasible);
  EXPECT_EQ(second.x, whole.x);
  ASSERT_EQ(indices.size(), static_cast<size_t>(whole.iterations) + 1);
  for (size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(indices[i], static_cast<int>(i));
  options.max_iterations = state.iteration;
  const NlpResult limited = SolveWithInteriorPoint(program, start, options, {}, {&state, nullptr}).result;
  EXPECT_EQ(limited.termination, Termination::kIterationLimit);
  EXPECT_EQ(limited.x, first.x);
}

TEST_F(Restored, StatesThatNoPhaseCanHaveDoNotFit) {
  AllStates keeper;
  Hs071 program(3);
  const NlpOptions options = suite::SuiteOptions();
  SolveWithInteriorPoint(program, {Hs071::Start(), {}, {}, {}}, options, {}, {nullptr, &keeper});
  ASSERT_TRUE(keeper.states.back().restoration.has_value());
  ASSERT_TRUE(Fits(keeper.states.back(), program, options));
  using Spoil = void (*)(RestorationState&);
  const Spoil spoils[] = {
      [](RestorationState& s) { s.w(0) = 0.5; },  // outside its bounds
      [](RestorationState& s) { s.w.resize(0); },
      [](RestorationState& s) { s.multipliers.lower(0) = 0; },
      [](RestorationState& s) { s.elastic.p(1) = 0; },
      [](RestorationState& s) { s.elastic.n(0) = -1; },
      [](RestorationState& s) { s.elastic.z_n(1) = kInfinity; },
      [](RestorationState& s) { s.elastic.z_p.resize(1); },
      [](RestorationState& s) { s.barrier.mu = 0; },
      [](RestorationState& s) { s.acceptance.theta_max = kInfinity; },
      [](RestorationState& s) { s.newton.threshold = 0; },
  };
  for (const Spoil& spoil : spoils) {
    InteriorPointState spoilt = keeper.states.back();
    spoil(*spoilt.restoration);
    EXPECT_FALSE(Fits(spoilt, program, options)) << &spoil - spoils;
  }
}

}  // namespace
}  // namespace rollgait
