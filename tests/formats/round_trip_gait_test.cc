// The human written as JSON, and as URDF with its side file, and read back: the gait is the same.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "client/formats/urdf.h"
#include "client/formats/urdf_side.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "client/json.h"
#include "core/gait/judge_solution.h"
#include "core/gait/optimizing_gait_solver.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"

namespace rollgait::client {
namespace {

// Presets choose the surfaces of the human's feet, so the body is that of the request.
GaitSpec Request(const v1::ModelSelection& model) {
  v1::SolveSpec spec;
  *spec.mutable_model() = model;
  spec.set_preset(v1::PRESET_HUMAN);
  spec.mutable_accuracy()->set_level(v1::Accuracy::LEVEL_DRAFT);
  // Two solutions of one problem are as close as their optimality conditions.
  spec.mutable_accuracy()->set_kkt_tolerance(1e-9);
  const Result<GaitSpec> checked = server::DecodeSpec(spec);
  EXPECT_TRUE(checked.ok()) << checked.violations()[0].field << " " << checked.violations()[0].message;
  return checked.value();
}

GaitSolution Walk(const v1::ModelSelection& model) {
  return OptimizingGaitSolver().Solve(Request(model), SolveControl());
}

// Of positions of all joints (rad, m) and of efforts, as a share of the largest.
struct Difference {
  double position = 0, effort = 0, objective = 0;
};

Difference Compare(const GaitSolution& a, const GaitSolution& b) {
  Difference difference;
  double largest = 0;
  if (a.trajectory->phases.size() != b.trajectory->phases.size()) return {kInfinity, kInfinity, kInfinity};
  for (size_t p = 0; p < a.trajectory->phases.size(); ++p) {
    const TrajectoryPhase &x = a.trajectory->phases[p], &y = b.trajectory->phases[p];
    difference.position = std::max(difference.position, (x.node_positions - y.node_positions).cwiseAbs().maxCoeff());
    difference.effort = std::max(difference.effort, (x.point_efforts - y.point_efforts).cwiseAbs().maxCoeff());
    largest = std::max(largest, x.point_efforts.cwiseAbs().maxCoeff());
  }
  difference.effort /= largest;
  difference.objective = std::abs(a.objective - b.objective) / a.objective;
  return difference;
}

TEST(RoundTripGaitTest, OfFilesThatWereWrittenIsTheSame) {
  v1::ModelSelection named, as_json, as_urdf;
  named.set_name("human29");
  const v1::Model written = server::EncodeModel(Request(named).scene, 9.81);
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(ToJsonText(written), as_json.mutable_own()).ok());
  const LinkTree tree = ReadLinkTreeText("human29.urdf", ToUrdf(written));
  v1::ModelSideFile side;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(ToJsonText(SideFileOfModel(written)), &side).ok());
  CheckSideFile("human29.side.json", side, tree);
  *as_urdf.mutable_own() = ModelOfTree(tree, "human29.side.json", side).model;

  const GaitSolution expected = Walk(named);
  ASSERT_EQ(expected.termination, Termination::kOptimal) << expected.message;
  for (const auto& [name, model] : {std::pair("JSON", as_json), {"URDF", as_urdf}}) {
    SCOPED_TRACE(name);
    const GaitSolution found = Walk(model);
    ASSERT_EQ(found.termination, Termination::kOptimal) << found.message;
    const Difference difference = Compare(expected, found);
    std::printf("human29 through %s: positions differ by %.1e, efforts by %.1e of the largest, the objective by %.1e\n",
                name, difference.position, difference.effort, difference.objective);
    EXPECT_LT(difference.position, 1e-9);
    EXPECT_LT(difference.effort, 1e-9);
    EXPECT_LT(difference.objective, 1e-9);
  }
}

}  // namespace
}  // namespace rollgait::client
