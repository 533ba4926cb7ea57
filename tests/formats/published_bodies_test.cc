// Bodies that nobody here described, from their file to a gait on three slopes: the side file is the proposed one.
// Prints a table.
#include "tests/formats/published_bodies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <numbers>

#include "client/import/side_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "client/json.h"
#include "core/gait/judge_solution.h"
#include "core/gait/optimizing_gait_solver.h"
#include "server/convert/gait_request_convert.h"

namespace rollgait::client {
namespace {

// Where ROLLGAIT_BODIES names a folder, the files are written there, for `rollgait solve`.
void Keep(const std::string& name, const std::string& text) {
  if (const char* const folder = std::getenv("ROLLGAIT_BODIES"))
    std::ofstream(std::string(folder) + "/" + name) << text;
}

class PublishedBodiesTest : public testing::TestWithParam<PublishedBody> {};
INSTANTIATE_TEST_SUITE_P(Bodies, PublishedBodiesTest, testing::ValuesIn(PublishedBodies()),
                         [](const auto& body) { return body.param.name; });

TEST_P(PublishedBodiesTest, WalksOnThreeSlopes) {
  const PublishedBody& body = GetParam();
  if (!body.text) GTEST_SKIP() << body.source << " is not installed: " << body.file;
  const std::string ending = body.file.substr(body.file.rfind('.'));
  Keep(body.name + ending, *body.text);
  const LinkTree tree = ReadLinkTreeText(body.file, *body.text);
  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.missing, testing::IsEmpty());
  const std::string side = ToJsonText(proposal.side);
  Keep(body.name + ".side.json", side);
  CheckSideFile("proposed", proposal.side, tree);
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = ModelOfTree(tree, "proposed", proposal.side).model;
  spec.set_preset(v1::PRESET_HUMAN);
  spec.mutable_motion()->set_speed_m_s(body.speed);
  for (const double slope : {-5.0, 0.0, 5.0}) {
    SCOPED_TRACE(slope);
    spec.set_slope_rad(slope * std::numbers::pi / 180);
    const Result<GaitSpec> checked = server::DecodeSpec(spec);
    ASSERT_TRUE(checked.ok()) << checked.violations()[0].field << " " << checked.violations()[0].message;
    const std::clock_t begin = std::clock();
    const GaitSolution solution = OptimizingGaitSolver().Solve(checked.value(), SolveControl());
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    int iterations = 0;
    for (const MeshStatistics& mesh : solution.meshes) iterations += mesh.iterations;
    const bool within = solution.within_requested_accuracy();
    std::printf("%-10s %2d joints, %3d lines of side file, slope %+2.0f°, %4d iterations, %5.1f s CPU, %s\n",
                body.name.c_str(), spec.model().own().joints_size(),
                static_cast<int>(std::count(side.begin(), side.end(), '\n')), slope, iterations, seconds,
                within ? "within" : solution.message.c_str());
    EXPECT_TRUE(Converged(solution.termination)) << solution.message;
    EXPECT_TRUE(within) << solution.message;
  }
}

}  // namespace
}  // namespace rollgait::client
