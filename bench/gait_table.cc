// Gaits from the built-in guess: iterations, time, objective and accuracy for every slope, scheme and mesh.
//   gait_table [--model planar] [--feet two] [--toes] [--sagittal] [--drop-arms] [--rigid-trunk] [--speed 1.3] [--step
//   0.65]
//              [--double 8]
//              [--intervals 8,16,32,64] [--schemes radau2,radau3,hermite-simpson] [--slopes -10,0,10]
//              [--costs torque:1,work:1 | --preset human [--extra force-rate:1e-8]] [--touch-down plastic] [--starts 3]
//              [--standard | --fine] [--verbose] [--normative]
// --normative prints how far each gait is from people's (core/validation/normative.h).

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/gait/optimizing_gait_solver.h"
#include "core/gait/presets.h"
#include "core/nlp/termination.h"
#include "core/trajectory/sampling.h"
#include "core/validation/overlap.h"

namespace rollgait {
namespace {

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Scheme SchemeOf(const std::string& word) {
  const SchemeTraits* traits = FindScheme(word);
  if (traits == nullptr) {
    std::fprintf(stderr, "--schemes %s is not known; rollgait solve --help lists them\n", word.c_str());
    std::exit(1);
  }
  return traits->scheme;
}

FootShape FeetOf(const std::string& name) {
  return name == "two" ? FootShape::kTwoEllipsoids : FootShape::kOneEllipsoid;
}

// A few by a short name, each by its field of CostTerm.
cost::Term TermOf(const std::string& name) {
  if (name == "force-rate") return cost::SquaredForceRate{};
  if (name == "rate") return cost::SquaredTorqueRate{};
  if (name == "work") return cost::MechanicalWork{};
  cost::Term term;
  ForEachCost([&]<typename Kind>(const CostRow<Kind>& row) {
    if (name == row.traits.field) term = Kind{};
  });
  return term;
}

std::vector<GaitRequest::CostTerm> CostsOf(const std::string& text) {
  std::vector<GaitRequest::CostTerm> costs;
  for (const std::string& part : Split(text)) {
    const size_t colon = part.find(':');
    costs.push_back({TermOf(part.substr(0, colon)), std::nullopt});
    if (colon != std::string::npos) costs.back().weight = std::stod(part.substr(colon + 1));
  }
  return costs;
}

Preset PresetOf(const std::string& name) {
  if (name == "torque") return Preset::kTorque;
  return name == "transport" ? Preset::kTransport : Preset::kHuman;
}

void PrintIteration(const IterationInfo& i) {
  std::fprintf(stderr, "  %4d f %.8e pr %.2e du %.2e mu %.1e reg %.1e ap %.2e ad %.2e%s\n", i.index, i.objective,
               i.primal_infeasibility, i.dual_infeasibility, i.barrier_parameter, i.regularization, i.primal_step,
               i.dual_step, i.restoration ? " R" : "");
}

std::string Text(const std::optional<double>& value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value.value_or(0));
  return value ? text : "-";
}

const char* Name(NormativeQuantity quantity) {
  switch (quantity) {
    case NormativeQuantity::kAngle:
      return "deg";
    case NormativeQuantity::kMoment:
      return "N m/kg";
    case NormativeQuantity::kVerticalForce:
      return "up %BW";
    case NormativeQuantity::kForwardForce:
      return "fore %BW";
  }
  return "?";
}

void PrintForcePeaks(const ForcePeaks& peaks) {
  std::printf("force %s / %s / %s %%BW%s", Text(peaks.first).c_str(), Text(peaks.valley).c_str(),
              Text(peaks.second).c_str(), peaks.two ? ", two peaks\n" : "\n");
}

void PrintNormative(const NormativeComparison& people) {
  std::printf(
      "    stance %.1f %%, double support %.1f %%, step %.3f m, cadence %.0f /min, opposite toe-off %s, "
      "opposite heel strike %s, toe-off %s %%, ",
      100 * people.stance, 100 * people.double_support, people.step_length, people.cadence,
      Text(people.opposite_toe_off).c_str(), Text(people.opposite_heel_strike).c_str(), Text(people.toe_off).c_str());
  PrintForcePeaks(people.peaks);
  std::printf("    at a limit through stance:");
  for (const RestingJoint& joint : people.resting) {
    std::printf(" %s %s %.0f %%", joint.joint.c_str(), joint.at_max ? "max" : "min", 100 * joint.share);
  }
  std::printf("\n");
  for (const DatasetComparison& set : people.datasets) {
    std::printf("    %s: stance %.1f %%, ", set.dataset.c_str(), 100 * set.stance);
    PrintForcePeaks(set.peaks);
    for (const CurveComparison& curve : set.curves) {
      std::printf("      %-5s %-8s r %6.3f  rms %7.3f = %5.2f sd  ours %7.2f .. %7.2f  people %7.2f .. %7.2f\n",
                  curve.joint.c_str(), Name(curve.quantity), curve.distance.correlation, curve.distance.rms,
                  curve.distance.rms_deviations, curve.min, curve.max, curve.normative_min, curve.normative_max);
    }
  }
}

// Impacts, and where forces of the collocation polynomials dip below zero between its points.
void PrintForces(const Trajectory& trajectory, const GaitSpec& spec) {
  const double weight = spec.scene.model.total_mass() * spec.gravity.norm();
  double least = 0;
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k) {
      for (int i = 0; i <= 10; ++i) {
        const MotionSample sample = Sample(trajectory, static_cast<int>(p), k, 0.1 * i);
        for (int row = 2; row < sample.forces.size(); row += 3) least = std::min(least, sample.forces(row));
      }
    }
    if (phase.impulses.size() == 0) continue;
    std::printf("    impact at %.3f s: %.2f J lost, normal impulses", phase.start, phase.impact_loss);
    for (int row = 2; row < phase.impulses.size(); row += 3) {
      std::printf(" %s %.2f", spec.scene.contacts[phase.contacts[row / 3]].name.c_str(), phase.impulses(row));
    }
    std::printf(" N s\n");
  }
  std::printf("    least normal force between points %.1f N = %.2f %%BW\n", least, 100 * least / weight);
}

// Which bodies overlap, by how much, and what it costs to know.
void PrintOverlaps(const Scene& scene, const Trajectory& trajectory) {
  const BodyDynamics dynamics(scene.model);
  const std::clock_t begin = std::clock();
  const OverlapFindings found = MeasureOverlap(scene, dynamics, trajectory);
  const double elapsed = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("    overlap %.4f mm (%s at %.3f s), judged in %.1f ms:", 1e3 * found.worst.value,
              found.worst.where.c_str(), found.worst.time, 1e3 * elapsed);
  for (const int pair : found.Deeper(0)) std::printf(" %s %.3f", scene.PairName(pair).c_str(), 1e3 * found.pairs[pair]);
  std::printf("\n");
}

int Main(int argc, char** argv) {
  std::vector<std::string> intervals = {"8", "16", "32", "64"}, slopes = {"-10", "0", "10"},
                           schemes = {"radau2", "radau3", "hermite-simpson"};
  bool verbose = false, normative = false;
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  std::vector<GaitRequest::CostTerm> extra;  // on top of the preset's
  auto level = GaitRequest::AccuracyLevel::kDraft;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--verbose") verbose = true;
    if (flag == "--normative") normative = true;
    if (flag == "--standard") level = GaitRequest::AccuracyLevel::kStandard;
    if (flag == "--fine") level = GaitRequest::AccuracyLevel::kFine;
    if (flag == "--toes") request.body.toes = true;
    if (flag == "--sagittal") request.body.sagittal = true;
    if (flag == "--drop-arms") request.body.drop_arms = true;
    if (flag == "--rigid-trunk") request.body.rigid_trunk = true;
    if (i + 1 >= argc) continue;
    if (flag == "--model") request.body.model = argv[++i];
    if (flag == "--feet") request.body.feet = FeetOf(argv[++i]);
    if (flag == "--speed") request.motion.speed = std::stod(argv[++i]);
    if (flag == "--step") request.motion.step_length = std::stod(argv[++i]);
    if (flag == "--double") request.discretization.double_support_intervals = std::stoi(argv[++i]);
    if (flag == "--costs") request.costs = CostsOf(argv[++i]);
    if (flag == "--preset") request.preset = PresetOf(argv[++i]);
    if (flag == "--extra") extra = CostsOf(argv[++i]);
    if (flag == "--touch-down" && argv[++i] == std::string("plastic")) {
      request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
    }
    if (flag == "--sex") request.body.sex = argv[++i] == std::string("female") ? Sex::kFemale : Sex::kMale;
    if (flag == "--stature") request.body.stature = std::stod(argv[++i]);
    if (flag == "--mass") request.body.mass = std::stod(argv[++i]);
    if (flag == "--starts") request.starts = std::stoi(argv[++i]);
    if (flag == "--intervals") intervals = Split(argv[++i]);
    if (flag == "--slopes") slopes = Split(argv[++i]);
    if (flag == "--schemes") schemes = Split(argv[++i]);
  }
  std::printf("%-16s %5s %4s | %-10s %4s %7s %7s | %9s %9s %6s | %9s %9s %8s %8s %8s | %5s %5s\n", "scheme", "slope",
              "N", "end", "iter", "cpu s", "eval s", "objective", "KKT", "step m", "gap m", "slip m/s", "defect q",
              "defect v", "energy", "minN", "fric");
  if (!extra.empty() && request.preset) {
    const Preset preset = *request.preset;
    FillFromPreset(&request);
    request.preset.reset();
    const GaitSpec spec = CheckRequest(request).value();
    request.costs = PresetCosts(preset, spec.scene, spec.similarity);
    request.costs.insert(request.costs.end(), extra.begin(), extra.end());
  }
  bool all = true;
  for (const auto& scheme : schemes) {
    for (const auto& slope : slopes) {
      for (const auto& n : intervals) {
        request.slope = std::stod(slope) * std::numbers::pi / 180;
        request.discretization.scheme = SchemeOf(scheme);
        request.discretization.single_support_intervals = std::stoi(n);
        request.accuracy.level = level;
        const Result<GaitSpec> spec = CheckRequest(request);
        if (!spec.ok()) {
          for (const Violation& v : spec.violations())
            std::fprintf(stderr, "%s: %s\n", v.field.c_str(), v.message.c_str());
          return 1;
        }
        SolveControl control;
        if (verbose) control.observer = PrintIteration;
        const std::clock_t begin = std::clock();
        const GaitSolution s = OptimizingGaitSolver().Solve(spec.value(), control);
        all &= s.termination == Termination::kOptimal;
        const AccuracyReport a = s.accuracy.value_or(AccuracyReport());
        const MeshStatistics& m = s.meshes.back();
        std::printf(
            "%-16s %5s %4s | %-10s %4d %7.3f %7.3f | %9.6g %9.2e %6.3f | %9.2e %9.2e %8.1e %8.1e %8.1e | %5.0f %5.2f\n",
            scheme.c_str(), slope.c_str(), n.c_str(), WordOf(s.termination), m.iterations,
            static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, m.evaluation_time, s.objective, s.kkt_error,
            s.step_length, a.max_gap, a.max_slip, a.max_position_defect, a.max_velocity_defect,
            a.energy_balance_error_relative, a.min_normal_force, a.max_friction_ratio);
        std::fflush(stdout);
        if (s.meshes.size() > 1) {
          for (const auto& mesh : s.meshes) {
            int total = 0;
            for (int count : mesh.intervals) total += count;
            std::printf("    mesh of %d intervals: %d iterations, %.3f s, objective %.3f, gap %.2e m, slip %.2e m/s\n",
                        total, mesh.iterations, mesh.wall_time, mesh.objective, mesh.max_gap, mesh.max_slip);
          }
        }
        if (s.trajectory) PrintForces(*s.trajectory, spec.value());
        if (s.trajectory) PrintOverlaps(spec.value().scene, *s.trajectory);
        if (a.impact_loss != 0) {
          std::printf("    impacts off by %.1e rad/s or m/s, %.1e N s\n", a.jump_velocity_error, a.jump_impulse_error);
        }
        if (normative && s.normative) PrintNormative(*s.normative);
        for (const auto& u : s.unmet_constraints) {
          std::printf("    unmet: %s phase %d t %.3f by %g %s\n", u.name.c_str(), u.phase, u.time, u.violation,
                      u.unit.c_str());
        }
      }
    }
  }
  return all ? 0 : 1;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
