// The same nonlinear program solved by the interior point method of core/nlp and by Ipopt with MUMPS, in turn, so that
// the ratio does not depend on how busy the machine is. One line a problem, the better of three runs each.
//   nlp_solvers [MODEL [INTERVALS]]        planar 16 unless given; set OPENBLAS_NUM_THREADS=1
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

template <typename Solve>
NlpResult Best(const Solve& solve) {
  NlpResult best;
  for (int run = 0; run < 3; ++run) {
    const NlpResult result = solve();
    if (run == 0 || result.wall_time_s < best.wall_time_s) best = result;
  }
  return best;
}

void Compare(const std::string& model, int intervals, double slope_degrees) {
  GaitRequest request;
  request.body.model = model;
  request.slope = slope_degrees * 3.14159265358979 / 180;
  request.motion.speed = 1.3;
  const auto spec = CheckRequest(request);
  if (!spec.ok()) {
    std::fprintf(stderr, "%s: %s\n", spec.violations()[0].field.c_str(), spec.violations()[0].message.c_str());
    std::exit(2);
  }
  const auto problem = BuildProblem(spec.value());
  CollocationNlp nlp(*problem, Scheme::kRadau2, Mesh::Uniform({intervals / 2, intervals}));
  const NlpStart start{nlp.MakeStart(WalkingGuess(spec.value(), *problem)), {}, {}, {}};
  const NlpResult ours = Best([&] { return SolveNlp(nlp, start, {}, {}); });
  const NlpResult ipopt = Best([&] { return SolveWithIpopt(nlp, start, {}, {}); });
  std::printf("%-8s %5.0f %4d %7d | %4d %7.3f %11.4f | %4d %7.3f %11.4f | %5.2f %5.2f\n", model.c_str(), slope_degrees,
              intervals, nlp.variables(), ours.iterations, ours.wall_time_s, ours.objective, ipopt.iterations,
              ipopt.wall_time_s, ipopt.objective, ipopt.wall_time_s / ours.wall_time_s,
              ipopt.wall_time_s / ipopt.iterations / (ours.wall_time_s / ours.iterations));
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) {
  const std::string model = argc > 1 ? argv[1] : "planar";
  const int intervals = argc > 2 ? std::atoi(argv[2]) : 16;
  std::printf("%-8s %5s %4s %7s | %4s %7s %11s | %4s %7s %11s | %5s %5s\n", "model", "slope", "N", "unknown", "iter",
              "s", "objective", "iter", "s", "objective", "ratio", "/iter");
  for (double slope : {-10.0, 0.0, 10.0}) rollgait::Compare(model, intervals, slope);
  return 0;
}
