// What a search leaves behind, and how another goes on from it; whole gaits: tests/core/gait/resumed_gait_test.cc.
#include "core/nlp/solve_journal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/byte_stream.h"
#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

// A search of three programs, each the last one's neighbour and started from it.
struct Search {
  JournalRecords records;  // left at its end
  std::vector<NlpResult> results;
  std::vector<int> iterations;  // as they were observed
  Continuation continuation;
  bool continued = false;
};

constexpr double kSums[] = {40, 41, 43};

// Stops after `most` observed iterations.
Search RunSearch(const JournalRecords& past, int most = 1'000'000, const double* sums = kSums) {
  Search search;
  search.records = past;
  SolveJournal::Sink sink;
  sink.finished = [&](int program, std::string record) {
    search.records.finished.resize(static_cast<size_t>(program));
    search.records.finished.push_back(std::move(record));
    search.records.started.clear();
  };
  sink.started = [&](int program, std::string record) {
    search.records.finished.resize(static_cast<size_t>(program));
    search.records.started = std::move(record);
  };
  sink.continued = [&](const Continuation& continuation) {
    EXPECT_FALSE(search.continued);
    search.continued = true;
    search.continuation = continuation;
  };
  SolveJournal journal(past, sink, {1, 1e9});
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& info) {
    search.iterations.push_back(info.index);
    if (static_cast<int>(search.iterations.size()) >= most) stop.Request();
  };
  NlpOptions options;
  options.tolerance = 1e-9;
  NlpStart start{Hs071::Start(), {}, {}, {}};
  for (int i = 0; i < 3 && !stop.requested(); ++i) {
    Hs071 problem(sums[i]);
    options.mesh = i;
    search.results.push_back(journal.Solve(problem, start, options, control));
    start.x = search.results.back().x;
  }
  return search;
}

void ExpectEqual(const NlpResult& a, const NlpResult& b) {
  EXPECT_EQ(a.termination, b.termination);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.objective, b.objective);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.constraint_multipliers, b.constraint_multipliers);
  EXPECT_EQ(a.lower_bound_multipliers, b.lower_bound_multipliers);
}

TEST(SolveJournalTest, AStoppedSearchGoesOnAsIfItHadNotBeen) {
  const Search whole = RunSearch({});
  ASSERT_EQ(whole.results.size(), 3u);
  const int total = static_cast<int>(whole.iterations.size());
  ASSERT_GT(total, 15);
  for (int stop = 1; stop < total; ++stop) {
    SCOPED_TRACE(stop);
    const Search first = RunSearch({}, stop), second = RunSearch(first.records);
    ASSERT_EQ(second.results.size(), 3u);
    EXPECT_EQ(second.continuation.ignored, "");
    // Every iteration once, in the same order.
    std::vector<int> iterations = first.iterations;
    iterations.insert(iterations.end(), second.iterations.begin(), second.iterations.end());
    EXPECT_EQ(iterations, whole.iterations);
    for (size_t i = 0; i < 3; ++i) ExpectEqual(second.results[i], whole.results[i]);
  }
}

TEST(SolveJournalTest, ASearchThatIsStoppedAgainAndAgainGetsToItsEnd) {
  const Search whole = RunSearch({});
  JournalRecords records;
  size_t iterations = 0;
  int runs = 0;
  for (; runs < 100; ++runs) {
    const Search part = RunSearch(records, 2);
    iterations += part.iterations.size();
    records = part.records;
    if (part.results.size() == 3 && part.results.back().termination == Termination::kOptimal) {
      ExpectEqual(part.results.back(), whole.results.back());
      break;
    }
  }
  EXPECT_LT(runs, 100);
  EXPECT_EQ(iterations, whole.iterations.size());
}

TEST(SolveJournalTest, FinishedProgramsAreNotSolvedAgain) {
  const Search whole = RunSearch({});
  ASSERT_EQ(whole.records.finished.size(), 3u);
  const Search again = RunSearch(whole.records);
  EXPECT_TRUE(again.iterations.empty());
  EXPECT_FALSE(again.continued) << "no program was solved";
  for (size_t i = 0; i < 3; ++i) ExpectEqual(again.results[i], whole.results[i]);
}

TEST(SolveJournalTest, OtherProgramsAreSolvedFromNothing) {
  const Search whole = RunSearch({});
  const double other_sums[] = {40, 41.5, 43};
  const Search other = RunSearch({}, 1'000'000, other_sums),
               from_records = RunSearch(whole.records, 1'000'000, other_sums);
  EXPECT_EQ(from_records.continuation.programs, 1);
  EXPECT_EQ(from_records.continuation.iteration, 0);
  EXPECT_EQ(from_records.continuation.ignored,
            "the record of program 1 is of another program than the one that is to be solved");
  for (size_t i = 0; i < 3; ++i) ExpectEqual(from_records.results[i], other.results[i]);
}

TEST(SolveJournalTest, DamagedRecordsAreLeft) {
  const Search whole = RunSearch({}), first = RunSearch({}, static_cast<int>(whole.iterations.size()) - 3);
  ASSERT_EQ(first.records.finished.size(), 2u);
  ASSERT_FALSE(first.records.started.empty());
  const auto expect_whole = [&](const JournalRecords& records, int programs) {
    const Search second = RunSearch(records);
    ASSERT_EQ(second.results.size(), 3u);
    EXPECT_EQ(second.continuation.programs, programs);
    EXPECT_EQ(second.continuation.iteration, 0);
    EXPECT_EQ(second.continuation.ignored,
              "the record of program " + std::to_string(programs) + " is damaged or of another version");
    ExpectEqual(second.results[2], whole.results[2]);
  };
  // Torn at every length, altered at every byte; a record of the other kind.
  for (size_t size = 0; size < first.records.started.size(); size += 7) {
    JournalRecords torn = first.records;
    torn.started.resize(std::max<size_t>(size, 1));
    expect_whole(torn, 2);
  }
  for (size_t i = 0; i < first.records.finished[1].size(); i += 5) {
    JournalRecords altered = first.records;
    altered.finished[1][i] = static_cast<char>(altered.finished[1][i] ^ 0x10);
    expect_whole(altered, 1);
  }
  JournalRecords other_kind = first.records;
  other_kind.finished[0] = other_kind.started;
  expect_whole(other_kind, 0);
}

// A search may ask for one more program before it looks at the stop flag.
TEST(SolveJournalTest, AStoppedSearchLeavesNothingMore) {
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  int reported = 0, kept = 0;
  control.observer = [&](const IterationInfo&) {
    if (++reported == 3) stop.Request();
  };
  SolveJournal::Sink sink;
  sink.started = [&](int, const std::string&) { ++kept; };
  sink.finished = [&](int, const std::string&) { ADD_FAILURE() << "none is finished"; };
  SolveJournal journal({}, sink, {1, 1e9});
  Hs071 problem;
  const NlpStart start{Hs071::Start(), {}, {}, {}};
  EXPECT_EQ(journal.Solve(problem, start, {}, control).termination, Termination::kCancelled);
  EXPECT_EQ(kept, 2);  // at iterations 1 and 2
  EXPECT_EQ(journal.Solve(problem, start, {}, control).termination, Termination::kCancelled);
  EXPECT_EQ(reported, 3);
  EXPECT_EQ(kept, 2);
}

// Bounds are moved outwards by less where the tolerance is small: a state of a rough solve may be outside those of an
// exact one.
TEST(SolveJournalTest, StatesFitTheToleranceThatTheyAreOf) {
  Hs071 problem;
  const NlpStart start{Hs071::Start(), {}, {}, {}};
  NlpOptions rough, exact;
  exact.tolerance = 1e-10;
  std::string kept;
  SolveJournal::Sink sink;
  sink.started = [&](int, std::string record) { kept = std::move(record); };
  SolveJournal(JournalRecords(), sink, {1, 1e9}).Solve(problem, start, exact, {});
  StartedProgram program;
  ASSERT_TRUE(Decode(kept, &program));
  EXPECT_TRUE(Fits(program.state, problem, exact));
  program.state.w(0) = 1 - 5e-9;  // its bound is 1
  EXPECT_TRUE(Fits(program.state, problem, rough));
  EXPECT_FALSE(Fits(program.state, problem, exact));
}

// With a checksum that is right, since whoever forges records computes it.
TEST(SolveJournalTest, StatesThatNoSolveCanHaveAreLeft) {
  Hs071 problem;
  NlpOptions options;
  const NlpStart start{Hs071::Start(), {}, {}, {}};
  std::string kept;
  SolveJournal::Sink sink;
  sink.started = [&](int, std::string record) {
    if (kept.empty()) kept = std::move(record);
  };
  SolveJournal(JournalRecords(), sink, {1, 1e9}).Solve(problem, start, options, {});
  StartedProgram good;
  ASSERT_TRUE(Decode(kept, &good));
  ASSERT_TRUE(Fits(good.state, problem, options));
  using Spoil = void (*)(InteriorPointState&);
  const Spoil spoils[] = {
      [](InteriorPointState& s) { s.w.conservativeResize(s.w.size() - 1); },
      [](InteriorPointState& s) { s.w(0) = 0.5; },  // outside its bounds
      [](InteriorPointState& s) { s.w(1) = std::nan(""); },
      [](InteriorPointState& s) { s.multipliers.lower(0) = -1; },
      [](InteriorPointState& s) { s.multipliers.upper(2) = 0; },
      [](InteriorPointState& s) { s.multipliers.y.resize(0); },
      [](InteriorPointState& s) { s.barrier.mu = 0; },
      [](InteriorPointState& s) { s.barrier.mu = std::nan(""); },
      [](InteriorPointState& s) { s.barrier.recent_step = std::nan(""); },
      [](InteriorPointState& s) { s.barrier.recent_step = 1.5; },
      [](InteriorPointState& s) { s.barrier.raised = -1; },
      [](InteriorPointState& s) { s.iteration = -1; },
      [](InteriorPointState& s) { s.elapsed_s = std::nan(""); },
      [](InteriorPointState& s) { s.newton.threshold = 0; },
      [](InteriorPointState& s) { s.newton.last_shift = -1; },
      [](InteriorPointState& s) { s.newton.skipped = -1; },
      [](InteriorPointState& s) { s.acceptance.theta_max = kInfinity; },
      [](InteriorPointState& s) {
        s.moved_bounds.push_back({99, 0, 1});
      },
      [](InteriorPointState& s) {
        s.moved_bounds.push_back({-1, 0, 1});
      },
      [](InteriorPointState& s) {
        s.moved_bounds.push_back({0, 2, 6});
      },  // moved inwards
  };
  for (const Spoil& spoil : spoils) {
    StartedProgram spoilt = good;
    spoil(spoilt.state);
    EXPECT_FALSE(Fits(spoilt.state, problem, options)) << &spoil - spoils;
    Continuation continuation;
    sink.continued = [&](const Continuation& c) { continuation = c; };
    SolveJournal journal({{}, Encode(spoilt)}, sink);
    EXPECT_EQ(journal.Solve(problem, start, options, {}).termination, Termination::kOptimal);
    EXPECT_NE(continuation.ignored, "") << &spoil - spoils;
  }
}

TEST(SolveJournalTest, LengthsBeyondTheBytesAllocateNothing) {
  ByteWriter out;
  out.Put(int64_t{1} << 60);
  ByteReader vector(out.bytes()), text(out.bytes());
  EXPECT_EQ(vector.Vector().size(), 0);
  EXPECT_FALSE(vector.ok());
  EXPECT_EQ(text.String(), "");
  EXPECT_FALSE(text.ok());
}

TEST(SolveJournalTest, StatesAreKeptAtTheirPace) {
  const auto kept_at = [](const SolveJournal::Pace& pace) {
    Hs071 problem;
    std::vector<int> iterations;
    SolveJournal::Sink sink;
    sink.started = [&](int, const std::string& record) {
      StartedProgram program;
      ASSERT_TRUE(Decode(record, &program));
      iterations.push_back(program.state.iteration);
    };
    SolveJournal(JournalRecords(), sink, pace).Solve(problem, {Hs071::Start(), {}, {}, {}}, {}, {});
    return iterations;
  };
  EXPECT_EQ(kept_at({3, 1e9}), (std::vector<int>{3, 6}));
  EXPECT_EQ(kept_at({1000, 1e9}), std::vector<int>());
  EXPECT_EQ(kept_at({1000, 0}).front(), 1);
}

// The time that was spent counts towards the limit.
TEST(SolveJournalTest, TimeGoesOn) {
  Search first = RunSearch({}, 5);
  StartedProgram program;
  ASSERT_TRUE(Decode(first.records.started, &program));
  program.state.elapsed_s = 1000;
  Hs071 problem;
  NlpOptions options;
  options.tolerance = 1e-9;
  SolveJournal journal({{}, Encode(program)}, {});
  const NlpResult result = journal.Solve(problem, {Hs071::Start(), {}, {}, {}}, options, {});
  EXPECT_EQ(result.termination, Termination::kTimeLimit);
  EXPECT_GE(result.wall_time_s, 1000);
  EXPECT_EQ(journal.earlier_s(), 1000);
}

}  // namespace
}  // namespace rollgait
