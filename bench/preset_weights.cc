// What the weights of the preset `human` do to the likeness to people: one gait for every set of weights.
//   preset_weights [--model human29] [--intervals 16] [--slope 0] [--speed 1.3] [--standard] WEIGHTS...
// WEIGHTS: those of the preset (core/gait/presets.cc) times factors, `rate=3,effort.ankle=2`; `-` for the preset as it
// is. A name is one of effort, work, passive, rate, acceleration, posture, for the whole term, or TERM.JOINT for one
// joint on either side. posture.JOINT of a joint that the preset leaves free (posture.base_yaw) and force-rate, a term
// that it does not have, are weights. Draft accuracy on --intervals in single support and half as many in double
// support, or with --standard refined to the bounds of that level. Columns: correlation of the angles of hip, knee and
// ankle with Falisse et al. / Winter; of the ankle's moment, with its peak in N m/kg, and of the hip's and the knee's;
// first peak, valley and second peak of the vertical force, % of body weight (0: none); largest angle by which the
// pelvis turns; step length; iterations and CPU time of the whole solve. Exit code 1 if one did not converge.
#include <algorithm>
#include <cstdio>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "bench/measured_solve.h"
#include "core/gait/judge_solution.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/gait/presets.h"

namespace rollgait {
namespace {

using Term = cost::Term;

std::string NameOf(const Term& term) {
  if (std::holds_alternative<cost::MuscleEffort>(term)) return "effort";
  if (std::holds_alternative<cost::MuscleWork>(term)) return "work";
  if (std::holds_alternative<cost::PassiveLoad>(term)) return "passive";
  if (std::holds_alternative<cost::SquaredTorqueRate>(term)) return "rate";
  if (std::holds_alternative<cost::SquaredAcceleration>(term)) return "acceleration";
  return std::holds_alternative<cost::Tracking>(term) ? "posture" : "";
}

// Joints of this name on either side.
std::vector<std::string> JointsNamed(const std::string& name, const Scene& scene) {
  std::vector<std::string> joints;
  for (const Joint& joint : scene.model.joints()) {
    if (joint.name == name || joint.name == name + "_l" || joint.name == name + "_r") joints.push_back(joint.name);
  }
  return joints;
}

// One joint's weight in a term times the factor; one that the term does not name has weight 1.
struct ScaleJoint {
  const std::string& joint;
  double factor;

  void operator()(cost::Tracking& posture) const {
    for (cost::Tracking::Channel& channel : posture.channels) {
      if (channel.joint != joint) continue;
      channel.weight = channel.weight.value_or(1) * factor;
      return;
    }
    posture.channels.push_back({joint, {0, 0}, factor});
  }
  template <typename Other>
  void operator()(Other& term) const {
    if constexpr (requires { term.joint_weights; }) {
      term.joint_weights[joint] = factor * (term.joint_weights.contains(joint) ? term.joint_weights.at(joint) : 1);
    }
  }
};

// False if the preset has no such term or the body no such joint.
bool Apply(const std::string& name, double factor, const Scene& scene, std::vector<GaitRequest::CostTerm>* costs) {
  if (name == "force-rate") {
    costs->push_back({cost::SquaredForceRate{}, factor});
    return true;
  }
  const size_t dot = name.find('.');
  for (GaitRequest::CostTerm& cost : *costs) {
    if (NameOf(cost.term) != name.substr(0, dot)) continue;
    if (dot == std::string::npos) {
      cost.weight = cost.weight.value_or(1) * factor;
      return true;
    }
    const std::vector<std::string> joints = JointsNamed(name.substr(dot + 1), scene);
    for (const std::string& joint : joints) std::visit(ScaleJoint{joint, factor}, cost.term);
    return !joints.empty();
  }
  return false;
}

bool ApplyAll(const std::string& weights, const Scene& scene, std::vector<GaitRequest::CostTerm>* costs) {
  if (weights == "-") return true;
  std::stringstream stream(weights);
  for (std::string part; std::getline(stream, part, ',');) {
    const size_t equal = part.find('=');
    if (equal != std::string::npos && Apply(part.substr(0, equal), std::stod(part.substr(equal + 1)), scene, costs)) {
      continue;
    }
    std::fprintf(stderr, "%s: not TERM=FACTOR or TERM.JOINT=FACTOR of the preset; see the top of preset_weights.cc\n",
                 part.c_str());
    return false;
  }
  return true;
}

// By data set (its first letter), joint and quantity.
using Curves = std::map<std::string, CurveComparison>;

Curves CurvesOf(const NormativeComparison& people) {
  Curves curves;
  for (const DatasetComparison& set : people.datasets) {
    for (const CurveComparison& curve : set.curves) {
      if (curve.quantity == NormativeQuantity::kAngle) curves[set.dataset.substr(0, 1) + " " + curve.joint] = curve;
      if (curve.quantity == NormativeQuantity::kMoment) curves["moment " + curve.joint] = curve;
    }
  }
  return curves;
}

// deg
double LargestYaw(const Scene& scene, const Trajectory& trajectory) {
  const int yaw = scene.model.Find(JointRole::kBaseYaw);
  double largest = 0;
  if (yaw < 0) return largest;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    largest = std::max(largest, phase.node_positions.row(yaw).cwiseAbs().maxCoeff());
  }
  return largest * 180 / std::numbers::pi;
}

bool SolveAndPrint(const std::string& weights, const GaitSpec& spec) {
  const MeasuredSolve measured = Measure([&spec] { return OptimizingGaitSolver().Solve(spec, {}); });
  const GaitSolution& solution = measured.solution;
  if (!Converged(solution.termination) || !solution.normative) {
    std::printf("%s: %s\n", weights.c_str(), solution.message.c_str());
    return false;
  }
  Curves curves = CurvesOf(*solution.normative);
  const auto r = [&curves](const char* of) { return curves[of].distance.correlation; };
  const ForcePeaks& peaks = solution.normative->peaks;
  std::printf(
      "%.2f/%.2f %.2f/%.2f %.2f/%.2f | %5.2f %5.2f %5.2f %5.2f | %3.0f/%3.0f/%3.0f | %5.1f %6.3f %4d %6.1f | %s",
      r("F hip"), r("W hip"), r("F knee"), r("W knee"), r("F ankle"), r("W ankle"), r("moment ankle"),
      curves["moment ankle"].max, r("moment hip"), r("moment knee"), peaks.first.value_or(0), peaks.valley.value_or(0),
      peaks.second.value_or(0), LargestYaw(spec.scene, *solution.trajectory), solution.step_length, measured.iterations,
      measured.cpu, weights.c_str());
  std::printf("%s\n", solution.verdict.kind == Verdict::Kind::kExceeded ? "  bounds exceeded" : "");
  std::fflush(stdout);
  return true;
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "human29";
  request.starts = 1;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  std::vector<std::string> rows;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    const std::string value = i + 1 < argc ? argv[i + 1] : "";
    if (flag == "--standard") {
      request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
    } else if (!flag.starts_with("--")) {
      rows.push_back(flag);
    } else {
      ++i;
      if (flag == "--model") request.body.model = value;
      if (flag == "--intervals") request.discretization.single_support_intervals = std::stoi(value);
      if (flag == "--slope") request.slope = std::stod(value) * std::numbers::pi / 180;
      if (flag == "--speed") request.motion.speed = std::stod(value);
    }
  }
  request.preset = Preset::kHuman;
  FillFromPreset(&request);
  request.preset.reset();
  std::printf("%-9s %-9s %-9s | %5s %5s %5s %5s | %-11s | %5s %6s %4s %6s | weights\n", "hip", "knee", "ankle", "ankle",
              "peak", "hip", "knee", "force %BW", "yaw", "step m", "iter", "cpu s");
  bool good = true;
  for (const std::string& weights : rows) {
    const Result<GaitSpec> as_it_is = CheckRequest(request);
    GaitRequest other = request;
    if (as_it_is.ok()) {
      other.costs = PresetCosts(Preset::kHuman, as_it_is.value().scene, as_it_is.value().similarity);
      if (!ApplyAll(weights, as_it_is.value().scene, &other.costs)) return 2;
    }
    const Result<GaitSpec> spec = CheckRequest(other);
    if (!spec.ok()) {
      for (const Violation& v : spec.violations()) std::fprintf(stderr, "%s: %s\n", v.field.c_str(), v.message.c_str());
      return 2;
    }
    good &= SolveAndPrint(weights, spec.value());
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
