// A gait that is solved in several processes, one after another, is the one that is solved in one.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/gait/gait_spec.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/nlp/solve_journal.h"

namespace rollgait {
namespace {

struct Part {
  GaitSolution solution;
  JournalRecords records;
  int iterations = 0;  // that were reported
  Continuation continuation;
};

// Until its end, or until `most` iterations have been reported and the process is killed: what was kept by then at the
// usual pace is all that is left.
Part Solve(const GaitSpec& spec, const JournalRecords& past, int most = 1'000'000) {
  Part run;
  run.records = past;
  StopFlag stop;
  SolveJournal::Sink sink;
  sink.finished = [&](int program, std::string record) {
    if (stop.requested()) return;  // it is dead
    run.records.finished.resize(static_cast<size_t>(program));
    run.records.finished.push_back(std::move(record));
    run.records.started.clear();
  };
  sink.started = [&](int program, std::string record) {
    if (stop.requested()) return;
    run.records.finished.resize(static_cast<size_t>(program));
    run.records.started = std::move(record);
  };
  sink.continued = [&](const Continuation& continuation) { run.continuation = continuation; };
  SolveJournal journal(past, sink);
  SolveControl control;
  control.stop = &stop;
  control.journal = &journal;
  control.observer = [&](const IterationInfo&) {
    if (++run.iterations >= most) stop.Request();
  };
  run.solution = OptimizingGaitSolver().Solve(spec, control);
  return run;
}

int IterationsOf(const GaitSolution& solution) {
  int sum = 0;
  for (const MeshStatistics& mesh : solution.meshes) sum += mesh.iterations;
  return sum;
}

// Kills the solve at about `kills` places, each time goes on, and compares.
void ExpectSameAfterKills(const GaitRequest& request, int kills) {
  const Result<GaitSpec> spec = CheckRequest(request);
  ASSERT_TRUE(spec.ok()) << spec.violations().front().message;
  const Part whole = Solve(spec.value(), {});
  ASSERT_TRUE(whole.solution.trajectory);
  ASSERT_EQ(whole.solution.termination, Termination::kOptimal) << whole.solution.message;
  const int step = std::max(1, whole.iterations / (kills + 1));
  for (int most = step; most < whole.iterations; most += step) {
    SCOPED_TRACE(std::to_string(most) + " of " + std::to_string(whole.iterations) + " iterations");
    const Part first = Solve(spec.value(), {}, most), second = Solve(spec.value(), first.records);
    EXPECT_EQ(second.continuation.ignored, "");
    EXPECT_EQ(second.solution.termination, whole.solution.termination);
    EXPECT_LE(first.iterations + second.iterations, whole.iterations + 3);
    EXPECT_EQ(IterationsOf(second.solution), IterationsOf(whole.solution));
    EXPECT_NEAR(second.solution.objective, whole.solution.objective, 1e-9 * whole.solution.objective);
    EXPECT_EQ(second.solution.trajectory->phases.front().node_velocities,
              whole.solution.trajectory->phases.front().node_velocities);
    EXPECT_EQ(second.solution.meshes.size(), whole.solution.meshes.size());
  }
}

TEST(ResumedGait, APlanarGaitWithFinerMeshesIsTheSame) {
  GaitRequest request;
  request.body.model = "planar";
  ExpectSameAfterKills(request, 12);
}

TEST(ResumedGait, ADraftOfHuman29IsTheSame) {
  GaitRequest request;
  request.body.model = "human29";
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  ExpectSameAfterKills(request, 5);
}

// A request that is alike in every size, but has another answer.
TEST(ResumedGait, RecordsOfAnotherRequestAreLeft) {
  GaitRequest request;
  request.body.model = "planar";
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  const GaitSpec level = CheckRequest(request).value();
  request.slope = 0.01;
  const GaitSpec slope = CheckRequest(request).value();
  const Part first = Solve(level, {}, 12), whole = Solve(slope, {}), second = Solve(slope, first.records);
  EXPECT_NE(second.continuation.ignored, "");
  EXPECT_EQ(second.continuation.programs, 0);
  EXPECT_EQ(second.iterations, whole.iterations);
  EXPECT_EQ(second.solution.objective, whole.solution.objective);
}

}  // namespace
}  // namespace rollgait
