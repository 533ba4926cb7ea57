// What one program of a search was and how it ended, each value by itself.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "server/convert/result_convert.h"

namespace rollgait::server {
namespace {

v1::SolveResult Encoded(const MeshStatistics& mesh, Termination termination) {
  GaitRequest request;
  request.body.model = "planar";
  GaitSolution solution;
  solution.termination = termination;
  solution.meshes = {mesh};
  return EncodeResult(solution, CheckRequest(request).value());
}

// The program and the whole search end differently; no two ends arrive as one.
TEST(EncodeMesh, EveryTerminationArrives) {
  const std::pair<Termination, const char*> kEnds[] = {
      {Termination::kOptimal, "TERMINATION_OPTIMAL"},
      {Termination::kAcceptable, "TERMINATION_ACCEPTABLE"},
      {Termination::kInfeasible, "TERMINATION_INFEASIBLE"},
      {Termination::kIterationLimit, "TERMINATION_ITERATION_LIMIT"},
      {Termination::kTimeLimit, "TERMINATION_TIME_LIMIT"},
      {Termination::kNumericalDifficulty, "TERMINATION_NUMERICAL_DIFFICULTY"},
      {Termination::kCancelled, "TERMINATION_CANCELLED"},
  };
  // Every value of the wire but the unspecified one has its row.
  EXPECT_EQ(static_cast<int>(std::size(kEnds)), v1::Termination_descriptor()->value_count() - 1);
  for (const auto& [program, name] : kEnds) {
    for (const auto& [search, name_of_search] : kEnds) {
      MeshStatistics mesh;
      mesh.termination = program;
      const v1::SolveResult result = Encoded(mesh, search);
      EXPECT_EQ(v1::Termination_Name(result.meshes(0).termination()), name);
      EXPECT_EQ(v1::Termination_Name(result.termination()), name_of_search);
    }
  }
}

TEST(EncodeMesh, EachFlagArrivesAlone) {
  using Set = void (*)(MeshStatistics*);
  const std::pair<Set, const char*> kFlags[] = {
      {[](MeshStatistics*) {}, ""},
      {[](MeshStatistics* mesh) { mesh->cycle = Cycle::kOnce; }, ""},
      {[](MeshStatistics* mesh) { mesh->cycle = Cycle::kHalf; }, "half cycle"},
      {[](MeshStatistics* mesh) { mesh->has_sides_alike = true; }, "sides alike"},
      {[](MeshStatistics* mesh) { mesh->has_added_rates = true; }, "torque rates"},
      {[](MeshStatistics* mesh) { mesh->for_errors = true; }, "for errors"},
  };
  for (const auto& [set, expected] : kFlags) {
    MeshStatistics mesh;
    set(&mesh);
    const v1::SolveResult result = Encoded(mesh, Termination::kOptimal);
    const v1::MeshStatistics& encoded = result.meshes(0);
    std::string found;
    if (encoded.half_cycle()) found += "half cycle";
    if (encoded.sides_alike()) found += "sides alike";
    if (encoded.added_torque_rates()) found += "torque rates";
    if (encoded.for_errors()) found += "for errors";
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace rollgait::server
