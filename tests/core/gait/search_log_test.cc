// The log of a search: GaitSolution::meshes lists every program, whatever the outcome, and an end that is forced in any
// program of the path is told as what it was.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include "core/gait/judge_solution.h"
#include "core/nlp/termination.h"
#include "tests/core/gait/planar_errors.h"

namespace rollgait {
namespace {

// Searches whose paths differ.
struct Path {
  const char* name;
  GaitRequest request;
};

GaitRequest Draft(double slope_degrees, Preset preset, int intervals) {
  GaitRequest request = Planar(slope_degrees, preset, intervals);
  request.accuracy.estimate_errors = false;
  return request;
}

GaitRequest Standard(double slope_degrees, Preset preset, int intervals) {
  GaitRequest request = Draft(slope_degrees, preset, intervals);
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  return request;
}

std::vector<Path> Paths() {
  std::vector<Path> paths;
  paths.push_back({"smoothing of powers that is reduced on finer meshes", Standard(0, Preset::kTransport, 12)});
  paths.push_back({"a fine mesh after coarse ones", Draft(5, Preset::kHuman, 26)});
  paths.push_back({"one step and its mirror image", Standard(5, Preset::kTorque, 12)});
  paths.back().request.cycle = Cycle::kFull;
  paths.push_back({"a body whose sides differ", Draft(0, Preset::kTorque, 6)});
  paths.back().request.body.changes.strengths["knee_l"] = 0.5;
  paths.push_back({"several starts", Standard(0, Preset::kTorque, 8)});
  paths.back().request.starts = 2;
  return paths;
}

// Iterations that the observer saw of each program.
struct Seen {
  std::vector<int> iterations;
  int sum() const {
    int all = 0;
    for (const int count : iterations) all += count;
    return all;
  }
};

using Cut = std::function<void(const IterationInfo&)>;

GaitSolution Search(const GaitRequest& request, Seen* seen, const Cut& cut = {}, const StopFlag* stop = nullptr) {
  SolveControl control;
  control.stop = stop;
  control.observer = [&](const IterationInfo& info) {
    if (static_cast<size_t>(info.mesh) >= seen->iterations.size()) seen->iterations.resize(info.mesh + 1, 0);
    seen->iterations[info.mesh] = info.index;
    if (cut) cut(info);
  };
  return SolvePlanar(request, control);
}

// Every program that ran is listed once, in order.
void ExpectComplete(const GaitSolution& solution, const Seen& seen) {
  EXPECT_GT(solution.wall_time, 0);
  ASSERT_EQ(solution.meshes.size(), seen.iterations.size()) << solution.message;
  for (size_t i = 0; i < seen.iterations.size(); ++i) {
    EXPECT_EQ(solution.meshes[i].iterations, seen.iterations[i]) << "program " << i;
    EXPECT_FALSE(solution.meshes[i].message.empty()) << "program " << i;
    EXPECT_NEAR(solution.meshes[i].slope, solution.meshes[0].slope, 1e-12);
  }
}

class SearchLog : public testing::TestWithParam<size_t> {
 protected:
  const Path path = Paths()[GetParam()];
};

TEST_P(SearchLog, ListsEveryProgramAndItsStart) {
  Seen seen;
  const GaitSolution solution = Search(path.request, &seen);
  ASSERT_TRUE(Converged(solution.termination)) << path.name << ": " << solution.message;
  ASSERT_GE(solution.meshes.size(), 2u) << path.name;
  ExpectComplete(solution, seen);
  EXPECT_EQ(solution.meshes.front().start, StartOf::kGuess);
  EXPECT_EQ(solution.meshes.back().termination, solution.termination);
  EXPECT_EQ(solution.meshes.back().cycle, solution.trajectory->cycle);
  EXPECT_FALSE(solution.meshes.back().has_sides_alike || solution.meshes.back().has_added_rates);
}

TEST_P(SearchLog, ACancelledProgramIsTheLastAndTheSearchIsCancelled) {
  Seen whole;
  const GaitSolution finished = Search(path.request, &whole);
  for (size_t program = 0; program < finished.meshes.size(); ++program) {
    Seen seen;
    StopFlag stop;
    const GaitSolution solution = Search(
        path.request, &seen,
        [&](const IterationInfo& info) {
          if (info.mesh == static_cast<int>(program) && info.index == 1) stop.Request();
        },
        &stop);
    SCOPED_TRACE(std::string(path.name) + ", program " + std::to_string(program));
    EXPECT_EQ(solution.termination, Termination::kCancelled) << solution.message;
    ExpectComplete(solution, seen);
    ASSERT_EQ(solution.meshes.size(), program + 1);
    EXPECT_EQ(solution.meshes.back().termination, Termination::kCancelled);
    for (size_t i = 0; i < program; ++i) {
      EXPECT_EQ(solution.meshes[i].termination, finished.meshes[i].termination);
      EXPECT_EQ(solution.meshes[i].start, finished.meshes[i].start);
    }
  }
}

TEST_P(SearchLog, AProgramWhoseTimeIsUpIsTheLastAndTheSearchSaysSo) {
  Seen whole;
  const GaitSolution finished = Search(path.request, &whole);
  const double limit = 1 + 5 * finished.wall_time;  // s; beside other work the search may take longer than it just did
  const size_t program = finished.meshes.size() - 1;
  GaitRequest request = path.request;
  request.solver_limits.max_wall_time = limit;
  Seen seen;
  const GaitSolution solution = Search(request, &seen, [&](const IterationInfo& info) {
    if (info.mesh == static_cast<int>(program) && info.index == 1) {
      std::this_thread::sleep_for(std::chrono::duration<double>(limit));
    }
  });
  SCOPED_TRACE(path.name);
  EXPECT_EQ(solution.termination, Termination::kTimeLimit) << solution.message;
  ExpectComplete(solution, seen);
  EXPECT_EQ(solution.meshes.back().termination, Termination::kTimeLimit);
}

// Also where a program uses up the last one by converging or by failing: what follows ends before its first, and since
// the whole search converges, no part of it says that there is no gait.
TEST_P(SearchLog, TheIterationsOfTheRequestAreNotExceeded) {
  Seen whole;
  const GaitSolution finished = Search(path.request, &whole);
  int all = 0;
  for (size_t program = 0; program + 1 < finished.meshes.size(); ++program) {
    all += finished.meshes[program].iterations;
    GaitRequest request = path.request;
    request.solver_limits.max_iterations = all;
    Seen seen;
    const GaitSolution solution = Search(request, &seen);
    SCOPED_TRACE(std::string(path.name) + ", program " + std::to_string(program));
    ExpectComplete(solution, seen);
    EXPECT_LE(seen.sum(), all);
    EXPECT_TRUE(Converged(solution.termination) || solution.termination == Termination::kIterationLimit)
        << WordOf(solution.termination) << ": " << solution.message;
    // An answer of a coarser mesh says that no finer one followed.
    EXPECT_TRUE(!Converged(solution.termination) || solution.message.find("did not converge") != std::string::npos)
        << solution.message;
  }
}

TEST_P(SearchLog, AProgramThatUsesUpTheIterationsIsTheLastAndSaysSo) {
  Seen whole;
  const GaitSolution finished = Search(path.request, &whole);
  int before = 0;
  for (size_t program = 0; program < finished.meshes.size(); ++program) {
    GaitRequest request = path.request;
    request.solver_limits.max_iterations = before + 1;
    before += finished.meshes[program].iterations;
    if (finished.meshes[program].iterations < 2) continue;  // it would end by itself
    Seen seen;
    const GaitSolution solution = Search(request, &seen);
    SCOPED_TRACE(std::string(path.name) + ", program " + std::to_string(program));
    ExpectComplete(solution, seen);
    EXPECT_EQ(seen.sum(), *request.solver_limits.max_iterations);
    EXPECT_EQ(solution.meshes.back().termination, Termination::kIterationLimit);
    // A coarser mesh's answer stays, with its verdict and the reason why no finer one followed.
    EXPECT_TRUE(solution.termination == Termination::kIterationLimit ||
                solution.message.find("did not converge") != std::string::npos)
        << solution.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, SearchLog, testing::Range<size_t>(0, 5));

}  // namespace
}  // namespace rollgait
