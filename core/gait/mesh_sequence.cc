#include "core/gait/mesh_sequence.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gait/added_constraints.h"
#include "core/gait/adopt_solution.h"
#include "core/gait/artefact.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/meshes.h"
#include "core/gait/solver_settings.h"
#include "core/nlp/termination.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

// The NLP whose solution the next one starts from, and that solution's multipliers.
struct Predecessor {
  std::unique_ptr<CollocationNlp> nlp;  // null: none
  NlpResult result;
};

// Settings of a program that starts from a solution. One that does not end soon is lost.
ProgramSettings SettingsNear(StartOf start, const GaitSpec& spec) {
  constexpr int kMostIterations = 300;  // those that succeed take 5 to 200
  ProgramSettings settings = SettingsFor(start, spec);
  settings.options.max_iterations = std::min(settings.options.max_iterations, kMostIterations);
  return settings;
}

ProgramSettings SettingsAt(const GaitSpec& spec, const MotionGuess& guess) {
  return guess.near_solution ? SettingsNear(StartOf::kFinerMesh, spec) : SettingsFor(StartOf::kGuess, spec);
}

// Whether the motion between the nodes counts; without bounds (draft) it does not.
bool IsBounded(const GaitSpec& spec) { return spec.bounds != NoBounds(); }

// The error to which a mesh is solved before its motion is judged: what follows is a third of the iterations, and is
// saved where the mesh is then refined. bench/success_rate, six requests of human29: 476 iterations in all with 1e-2,
// 456 with 0.1. But with 0.1 motions of squared torque on steep slopes are refined for what they are on the way to,
// until no refinement is left: of the first 13 requests of bench/verdict_audit (seed 1) three exceeded a bound, with
// 1e-2 one.
constexpr double kFirstJudged = 1e-2;

std::string WouldBeTooFine() {
  return " A finer mesh would have more than " + std::to_string(kMostIntervals) + " intervals.";
}

// Nothing is left for a finer mesh to do.
bool IsDone(const GaitSolution& solution) { return solution.verdict.kind != Verdict::Kind::kExceeded; }

// The last refinement was to halve a slip that was too large, and did not. Where a joint meets its limit the
// acceleration jumps, and the jump moves on from the intervals that were split to the next coarse one, where slipping
// pays.
bool Stalled(const GaitSpec& spec, const std::vector<MeshStatistics>& log, size_t first) {
  if (log.size() < first + 2) return false;
  const double bound = spec.bounds[Criterion::kSlip], before = log.end()[-2].max_slip, now = log.back().max_slip;
  return before > bound && now > std::max(bound, 0.5 * before);
}

// Solves one NLP, from a guess and the multipliers of its predecessor, if there is one; on the same mesh and with the
// same constraints it is the same NLP.
Predecessor SolveOneMesh(const GaitSpec& spec, const OptimalControlProblem& problem, const Mesh& mesh,
                         const AddedConstraints& added, const MotionGuess& guess, Predecessor previous,
                         NlpOptions options, bool can_refine, SolveBudget* budget) {
  Predecessor solved;
  NlpStart start;
  if (previous.nlp && previous.nlp->mesh().fractions == mesh.fractions && previous.nlp->added() == added) {
    previous.nlp->TransferMultipliers(*previous.nlp, previous.result, &start);
    solved.nlp = std::move(previous.nlp);
  } else {
    solved.nlp = std::make_unique<CollocationNlp>(problem, spec.scheme, mesh, added);
    if (previous.nlp) solved.nlp->TransferMultipliers(*previous.nlp, previous.result, &start);
  }
  start.x = solved.nlp->MakeStart(guess);
  if (can_refine) {
    options.rough_tolerance = kFirstJudged;
    options.worth_finishing = [&](const VectorX& x) { return IsWithinBounds(spec, solved.nlp->Extract(x.data())); };
  }
  previous = {};  // its memory is of use to the solve
  solved.result = budget->Run(*solved.nlp, start, options);
  return solved;
}

// The NLP of the solution on its mesh, as if this problem had been it: its rows and unknowns mean the
// same. None without multipliers, and where their numbers tell that it had other rows.
Predecessor PredecessorOf(const GaitSpec& spec, const OptimalControlProblem& problem, const WarmStart& solution,
                          const Mesh& mesh) {
  Predecessor previous;
  if (!solution.multipliers) return previous;
  const SolutionMultipliers& multipliers = *solution.multipliers;
  auto nlp = std::make_unique<CollocationNlp>(problem, spec.scheme, mesh, solution.added);
  if (multipliers.rows.size() != nlp->constraints() || multipliers.bounds.size() != nlp->variables()) return previous;
  previous.result.constraint_multipliers = nlp->objective_scale() * multipliers.rows;
  previous.result.lower_bound_multipliers = nlp->objective_scale() * multipliers.bounds.cwiseMax(0);
  previous.result.upper_bound_multipliers = -nlp->objective_scale() * multipliers.bounds.cwiseMin(0);
  previous.nlp = std::move(nlp);
  return previous;
}

// Solves the mesh of a rough solution to the tolerance of the request, since no finer mesh follows.
void Finish(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget, GaitSolution* solution) {
  const WarmStart start{*solution->trajectory, solution->multipliers, solution->added};
  const Mesh mesh = MeshOf(start.trajectory);
  const ProgramSettings settings = SettingsNear(StartOf::kSameMesh, spec);
  const Predecessor finished = SolveOneMesh(spec, problem, mesh, start.added, GuessFromTrajectory(start.trajectory),
                                            PredecessorOf(spec, problem, start, mesh), settings.options, false, budget);
  MeshStatistics statistics = Describe(spec, settings.start, *finished.nlp, finished.result);
  solution->termination = finished.result.termination;
  solution->message = finished.result.message;
  if (finished.result.x.size() > 0 && finished.result.x.allFinite()) {
    Adopt(spec, problem, *finished.nlp, finished.result, solution, &statistics);
  }
  budget->Record(statistics);
}

GaitSolution SolveFrom(const GaitSpec& spec, const OptimalControlProblem& problem, MotionGuess guess,
                       ProgramSettings settings, Predecessor previous, Mesh mesh, AddedConstraints added,
                       SolveBudget* budget) {
  constexpr int kMostAdditions = 4;   // rounds that add constraints on the mesh as it is
  constexpr int kMostEdgeRounds = 3;  // the same for edges of friction pyramids, where nothing else is left to do
  const size_t first = budget->log().size();
  GaitSolution solution;
  std::optional<GaitSolution> within;  // what a round of edges started from
  int refinements = 0, additions = 0, edge_rounds = 0;
  bool is_rough = false;
  std::string remark;
  while (true) {
    const bool can_refine = IsBounded(spec) && refinements < spec.max_refinements;
    Predecessor current =
        SolveOneMesh(spec, problem, mesh, added, guess, std::move(previous), settings.options, can_refine, budget);
    CollocationNlp& nlp = *current.nlp;
    const NlpResult& result = current.result;
    MeshStatistics statistics = Describe(spec, settings.start, nlp, result);
    // A finer mesh that fails does not take back a real answer of the coarser one.
    const bool keep_previous =
        budget->log().size() > first && !Converged(result.termination) && !IsArtefact(spec, solution);
    if (!keep_previous) {
      solution.termination = result.termination;
      solution.message = result.message;
      is_rough = result.rough;
      if (result.x.size() > 0 && result.x.allFinite()) {
        Adopt(spec, problem, nlp, result, &solution, &statistics);
      }
    }
    budget->Record(statistics);
    if (keep_previous) {
      remark = (within ? " With more edges of the friction pyramids it did not converge ("
                       : " The next finer mesh did not converge (") +
               result.message + ")";
      break;
    }
    // From a guess a coarse mesh takes long where it has no motion to offer. So may a finer one, but hardly twice.
    const bool leads_nowhere = refinements == 0 && result.termination == Termination::kIterationLimit &&
                               !guess.near_solution && can_refine && solution.trajectory && budget->Left();
    if (!Converged(result.termination) && !leads_nowhere) break;
    budget->Offer(spec, solution);
    const bool is_artefact = leads_nowhere || IsArtefact(spec, solution);
    // The multipliers of a program that stalled do not say what the sides cost.
    const bool has_new_edges =
        !is_artefact && !spec.is_only_a_start && result.termination == Termination::kOptimal &&
        AddFrictionEdges(nlp.FlatSides(result.x.data(), result.constraint_multipliers),
                         LeastCostOfASide(spec, solution.objective, nlp.typical_objective()), &added);
    if (!leads_nowhere && IsDone(solution)) {
      if (!has_new_edges || edge_rounds++ == kMostEdgeRounds) break;
      within = solution;
      guess = GuessFromTrajectory(*solution.trajectory);
      settings = SettingsNear(StartOf::kFinerMesh, spec);
      previous = std::move(current);
      continue;
    }
    if (!is_artefact && !spec.is_only_a_start && additions < kMostAdditions &&
        AddOverlapping(spec, *solution.accuracy, &added)) {
      // Bodies that overlapped move a long way: on the same mesh first, and as from the solution of a neighbour.
      ++additions;
      guess = GuessFromTrajectory(*solution.trajectory);
      settings = SettingsNear(StartOf::kNeighbour, spec);
      previous = std::move(current);
      continue;
    }
    if (spec.max_refinements == 0) break;
    if (is_artefact) {
      if (refinements++ == spec.max_refinements) break;
      // Start afresh: a finer mesh started from there would stay near it. Feet slip where joints leave their ranges
      // and velocities between the nodes, so those that did are bounded there (docs/explanation/optimizer.md).
      AddViolated(spec, *solution.trajectory, *solution.accuracy, &added);
      mesh = Halved(mesh);
      if (TotalIntervals(mesh) > kMostIntervals) {
        remark = WouldBeTooFine();
        break;
      }
      previous = {};
      continue;
    }
    const Mesh finer =
        RefineMesh(mesh, spec, *solution.trajectory, *solution.accuracy, Stalled(spec, budget->log(), first));
    const bool is_finer = finer.fractions != mesh.fractions;
    if (is_finer && TotalIntervals(finer) > kMostIntervals) {
      remark = WouldBeTooFine();
      break;
    }
    const bool adds = AddViolated(spec, *solution.trajectory, *solution.accuracy, &added);
    if (is_finer ? refinements++ == spec.max_refinements : !adds || additions++ == kMostAdditions) break;
    mesh = finer;
    guess = GuessFromTrajectory(*solution.trajectory);
    settings = SettingsNear(StartOf::kFinerMesh, spec);
    previous = std::move(current);
  }
  if (within && solution.verdict.kind == Verdict::Kind::kExceeded) {
    // More edges do not take back an answer within the bounds.
    solution = std::move(*within);
    remark = " With more edges of the friction pyramids not every bound was met.";
    is_rough = false;
  }
  if (is_rough && budget->Left()) {
    Finish(spec, problem, budget, &solution);
  } else if (is_rough) {
    solution.termination = budget->Cut().value_or(Termination::kIterationLimit);
    solution.message = Explain(solution.termination);
  }
  solution.message += remark;
  // Without bounds (draft) the request asks for the optimum of its mesh, whatever that is worth; the report tells.
  if (IsBounded(spec) && Converged(solution.termination) && IsArtefact(spec, solution)) {
    RefuseArtefact(spec, &solution);
  } else if (solution.verdict.kind == Verdict::Kind::kExceeded && spec.max_refinements > 0) {
    solution.message += " Bounds that are not met: " + Describe(solution.verdict.excesses) + ".";
  }
  solution.wall_time = budget->elapsed();
  return solution;
}

AddedConstraints ConstraintsAfter(const WarmStart& start) {
  AddedConstraints added = start.added;
  KeepApart(start.overlapping, &added);
  return added;
}

// Without bounds the constraints between the points are left out; edges only shape the cone.
AddedConstraints EdgesOf(const AddedConstraints& all) {
  AddedConstraints edges;
  for (const BoundedBetween& phase : all.between) edges.between.emplace_back().friction = phase.friction;
  return edges;
}

// From the spec's warm start, refined by what is known of its motion, if anything is.
GaitSolution SolveFromStored(const GaitSpec& spec, const OptimalControlProblem& problem, StartOf start_of,
                             int max_iterations, const AccuracyReport* report, SolveBudget* budget) {
  const Trajectory& trajectory = spec.warm_start->trajectory;
  Mesh mesh = RequestedMesh(spec), other = MeshOf(trajectory);
  if (IsSameMesh(mesh, other)) other = mesh;
  if (IsBounded(spec) && IsAtLeastAsFine(other, mesh)) mesh = other;
  Predecessor previous = PredecessorOf(spec, problem, *spec.warm_start, other);
  const bool used_multipliers = previous.nlp != nullptr;
  if (report != nullptr && IsSameMesh(mesh, other)) {
    Mesh finer = RefineMesh(mesh, spec, trajectory, *report, false);
    if (TotalIntervals(finer) <= kMostIntervals) mesh = std::move(finer);
  }
  ProgramSettings settings = SettingsFor(start_of, spec);
  settings.options.max_iterations = max_iterations;
  GaitSolution solution =
      SolveFrom(spec, problem, GuessFromTrajectory(trajectory), settings, std::move(previous), std::move(mesh),
                IsBounded(spec) ? ConstraintsAfter(*spec.warm_start) : EdgesOf(spec.warm_start->added), budget);
  solution.warm_started = start_of == StartOf::kOtherRequest;  // what the request names
  solution.used_multipliers = solution.warm_started && used_multipliers;
  return solution;
}

}  // namespace

GaitSolution SolveOnMeshes(const GaitSpec& spec, const OptimalControlProblem& problem, const MotionGuess& guess,
                           Mesh mesh, SolveBudget* budget) {
  return SolveFrom(spec, problem, guess, SettingsAt(spec, guess), {}, std::move(mesh), UsualConstraints(spec), budget);
}

WarmStart StartFrom(const GaitSpec& spec, const GaitSolution& solution) {
  WarmStart start{*solution.trajectory, solution.multipliers, solution.added};
  if (spec.bounds[Criterion::kOverlap] < kInfinity) start.overlapping = solution.accuracy->overlapping_pairs;
  return start;
}

GaitSolution SolveFromCoarser(const GaitSpec& spec, const OptimalControlProblem& problem, const WarmStart& coarser,
                              Mesh mesh, SolveBudget* budget) {
  const Mesh other = MeshOf(coarser.trajectory);
  const ProgramSettings settings =
      SettingsFor(HasShorterIntervals(mesh, other) ? StartOf::kFinerMesh : StartOf::kSameMesh, spec);
  return SolveFrom(spec, problem, GuessFromTrajectory(coarser.trajectory), settings,
                   PredecessorOf(spec, problem, coarser, other), std::move(mesh), ConstraintsAfter(coarser), budget);
}

GaitSolution SolveFromWarmStart(const GaitSpec& spec, const OptimalControlProblem& problem, int max_iterations,
                                SolveBudget* budget) {
  return SolveFromStored(spec, problem, StartOf::kOtherRequest, max_iterations, nullptr, budget);
}

GaitSolution SolveFromNeighbour(const GaitSpec& spec, const OptimalControlProblem& problem, int max_iterations,
                                SolveBudget* budget) {
  return SolveFromStored(spec, problem, StartOf::kNeighbour, max_iterations, nullptr, budget);
}

GaitSolution SolveFromImage(const GaitSpec& spec, const OptimalControlProblem& problem, int max_iterations,
                            SolveBudget* budget) {
  return SolveFromStored(spec, problem, StartOf::kImage, max_iterations, nullptr, budget);
}

GaitSolution SolveFromSmoother(const GaitSpec& spec, const OptimalControlProblem& problem, const GaitSolution& smoother,
                               int max_iterations, SolveBudget* budget) {
  // Where its motion misses a bound the next one will as well, so the mesh in between need not be solved.
  const bool refines = IsBounded(spec) && spec.max_refinements > 0 && smoother.accuracy &&
                       !smoother.accuracy->intervals.empty() && !IsArtefact(spec, smoother);
  return SolveFromStored(spec, problem, refines ? StartOf::kSmoother : StartOf::kNeighbour, max_iterations,
                         refines ? &*smoother.accuracy : nullptr, budget);
}

}  // namespace rollgait
