#include "core/gait/solver_settings.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/gait/power_smoothing.h"
#include "core/nlp/barrier_parameter.h"

namespace rollgait {
namespace {

// Which costs a row of the table serves. Powers have minima side by side: the closer to its bounds a program starts,
// the more surely it stays with the minimum that it knows.
enum class Costs { kAny, kWithoutPowers, kWithPowers };

struct Settings {
  StartOf start;
  Costs costs;
  double initial_barrier, warm_push, barrier_tolerance, barrier_exponent;
  bool recentre;
  double step_residual, first_shift;
};

// Found by trial on human29 and the planar human; docs/explanation/optimizer.md has the figures.
//  * A guess takes Ipopt's own values but for the first shift.
//  * From a neighbour bounds become active and inactive: start well inside of them and follow the barrier loosely.
//  * Smoother powers on a coarser mesh: the finer the mesh, the larger the accelerations that a push asks for, and with
//    1e-2 they violate the start by 30 to 250 times the size of a row. 96 solves of success_rate (both models, `human`
//    and `transport`): 7900 iterations and 5 programs that led nowhere with μ = 1e-3 and a push of 1e-2; 6800 and none
//    with μ = 1e-4 and 1e-3. With μ = 1e-5 the finer meshes after it take less (docs/explanation/optimizer.md).
//  * The first Hessian that needs a shift is refused 1e-4, from a guess and from smoother powers alike: in 48 solves of
//    success_rate the ladder 1e-4, 1e-2, 1, 100 ended at 1e-2 or 1 from a guess, and from smoother powers at 1 in 65 of
//    69. To begin there spares the factorisations before it: 2 to 3 of a hundred.
//  * From another request the first Hessian often needs a shift, and 1e-4 is refused. With powers, pushed further off
//    the bounds, neighbours of human29 take twice the iterations.
//  * A mirror image is the solution but for its multipliers, so it starts with the last μ of its half. Seed 7 of
//    bench/verdict_audit, #24, #88 and #159: 4, 3 and 11 iterations; 142, 111 and 96 as from a neighbour.
//  * Between meshes the active bounds are known. Planar, transport, level: 19 iterations with a push of 1e-4, none
//    within 900 with 1e-3. With powers μ = 1e-6: the multipliers are those of the last μ, and a larger one has to come
//    down again, which takes a quarter of the iterations where few intervals are new. Where no interval is shorter than
//    before, the solution is closest of all.
//  * Steps from a start that is close to a solution are refined to kResidual, a third of what KktSystem takes as a
//    solution at all; 55 requests of bench/one_sided and success_rate take 274 700 solutions (weighted by unknowns)
//    where 1e-8 takes 353 800, and no more iterations (133 500, 137 200). With 1e-4 one request comes to no end.
constexpr double kResidual = 3e-7;
constexpr Settings kTable[] = {
    {StartOf::kGuess, Costs::kAny, 0.1, 0, 10, 1.5, false, 1e-10, 1e-2},
    {StartOf::kNeighbour, Costs::kAny, 1e-2, 1e-2, 1000, 2.2, true, kResidual, 1e-4},
    {StartOf::kSmoother, Costs::kAny, 1e-5, 1e-3, 1000, 2.2, true, kResidual, 1},
    {StartOf::kOtherRequest, Costs::kWithoutPowers, 1e-2, 5e-3, 1000, 2, true, kResidual, 1e-2},
    {StartOf::kOtherRequest, Costs::kWithPowers, 1e-4, 1e-4, 10000, 2.2, true, kResidual, 1e-2},
    {StartOf::kFinerMesh, Costs::kWithoutPowers, 1e-3, 1e-3, 10, 1.5, false, 1e-10, 1e-4},
    {StartOf::kFinerMesh, Costs::kWithPowers, 1e-6, 1e-4, 1000, 2.2, true, kResidual, 1e-4},
    {StartOf::kImage, Costs::kAny, 0, 1e-9, 10, 1.5, false, 1e-10, 1e-4},
    {StartOf::kSameMesh, Costs::kWithoutPowers, 1e-4, 1e-4, 1000, 2.2, true, kResidual, 1e-4},
    {StartOf::kSameMesh, Costs::kWithPowers, 1e-5, 1e-5, 1000, 2.2, true, kResidual, 1e-4},
};

// human29, six requests: 469 iterations in all, 520 with 1e-3; with 0.1 they are 447, but some planar gaits then end in
// a minimum that is 3 % dearer.
constexpr double kStartTolerance = 1e-2;

}  // namespace

double ToleranceOfStart(const GaitSpec& spec) { return std::max(kStartTolerance, spec.kkt_tolerance); }

const int MostIterations::kFromGuess = 200;     // those that succeed take 30 to 130
const int MostIterations::kWithoutRates = 120;  // most that succeed take 20 to 100
// Of 57 full cycles of seed 7 of bench/verdict_audit 54 take 1 to 13. The other three, 24, 68 and 74, end in no 30;
// from a neighbour they come to steps that are unequal, and 3.5 to 13 % cheaper.
const int MostIterations::kFromImage = 30;
// bench/one_sided, human29: 29 with a locked ankle, 42 with a short thigh, 28 with a load, 22 with a weak knee, 38 with
// a prosthetic foot, and no later program of theirs takes more than 80. 2.5 times that.
const int MostIterations::kFromSymmetric = 200;
const int MostIterations::kFromWarmStart = 200;  // cold starts take fewer

ProgramSettings SettingsFor(StartOf start, const GaitSpec& spec) {
  const Costs costs = LeastSmoothing(spec) ? Costs::kWithPowers : Costs::kWithoutPowers;
  for (const Settings& row : kTable) {
    if (row.start != start || (row.costs != Costs::kAny && row.costs != costs)) continue;
    NlpOptions options;
    options.solver = spec.nlp_solver;
    options.tolerance = spec.kkt_tolerance;
    options.max_iterations = spec.max_iterations;
    options.initial_barrier = row.initial_barrier;
    options.warm_push = row.warm_push;
    options.barrier_tolerance = row.barrier_tolerance;
    options.barrier_exponent = row.barrier_exponent;
    options.recentre = row.recentre;
    options.step_residual = row.step_residual;
    options.first_shift = row.first_shift;
    if (start == StartOf::kImage) {
      options.estimate_multipliers = true;
      options.initial_barrier = BarrierParameter::Least(options.tolerance);
    }
    return {start, options};
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace rollgait
