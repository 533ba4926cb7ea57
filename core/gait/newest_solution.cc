#include "core/gait/newest_solution.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "core/gait/artefact.h"
#include "core/gait/error_estimate.h"
#include "core/gait/judge_solution.h"
#include "core/gait/meshes.h"
#include "core/gait/own_units.h"
#include "core/gait/power_smoothing.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

bool HasSameWeights(const GaitSpec& one, const GaitSpec& other) {
  return std::equal(one.costs.begin(), one.costs.end(), other.costs.begin(), other.costs.end(),
                    [](const auto& a, const auto& b) { return a.weight == b.weight; });
}

// Whether it is all that the request asks for. In own units.
bool IsComplete(const GaitSpec& own, const GaitSolution& solution) {
  if (!Converged(solution.termination) || solution.verdict.kind == Verdict::Kind::kExceeded) return false;
  if (!own.estimate_errors) return true;
  if (!solution.finer) return false;
  return !own.max_error || WorstShareOf(*own.max_error, EstimateErrors(own.scene, solution, *solution.finer)) <= 1;
}

std::string IntervalsOf(const Trajectory& trajectory) {
  std::string text;
  for (const int intervals : MeshOf(trajectory).Intervals()) {
    text += (text.empty() ? "" : " + ") + std::to_string(intervals);
  }
  return text;
}

// By how much powers are smoother than in the request, W.
double ExcessSmoothing(const GaitSpec& own, const GaitSolution& solution) {
  const double smoothing = solution.meshes.empty() ? 0 : solution.meshes.back().smoothing;
  const double watt = own.units.mass / std::pow(own.units.time, 3);
  return watt * std::max(0.0, smoothing - LeastSmoothing(own).value_or(smoothing));
}

// What the newest solution is, and by what it differs from the request's.
std::string Describe(const GaitSpec& own, const GaitSolution& solution) {
  std::ostringstream text;
  text << " The trajectory is the newest solution of a program that converged, on " << IntervalsOf(*solution.trajectory)
       << " intervals";
  const double excess = ExcessSmoothing(own, solution);
  if (excess > 0) text << ", with powers smoothed by " << excess << " W more than in the request";
  text << ".";
  if (solution.verdict.kind == Verdict::Kind::kExceeded) {
    text << " Bounds that are not met: " << rollgait::Describe(solution.verdict.excesses) << ".";
  }
  return text.str();
}

}  // namespace

bool NewestSolution::IsOfRequest(const GaitSpec& spec) const {
  return spec.slope == own_.slope && spec.cycle == own_.cycle && HasSameWeights(spec, own_);
}

void NewestSolution::Offer(const GaitSpec& spec, const GaitSolution& solution, double elapsed) {
  if (!Converged(solution.termination) || !solution.trajectory || !IsOfRequest(spec)) return;
  if (IsArtefact(spec, solution)) return;
  GaitSolution offered = solution;
  // The program may have left bounds to those after it.
  offered.verdict = JudgeFindings(offered.accuracy->findings, own_.bounds);
  const bool is_sharp = LeastSmoothing(spec) == LeastSmoothing(own_);
  const bool is_within = offered.verdict.kind != Verdict::Kind::kExceeded;
  const int rank = 4 * is_sharp + 2 * is_within + offered.finer.has_value();
  if (solution_ && rank < rank_) return;
  rank_ = rank;
  offered.wall_time = elapsed;
  solution_ = std::move(offered);
  if (sink_ == nullptr) return;
  GaitSolution shown = InSi(units_, request_, *solution_);
  if (shown.finer) shown.errors = EstimateErrors(request_.scene, shown, *shown.finer);
  if (shown.errors && request_.max_error) {
    shown.errors->is_within_max_error = WorstShareOf(*request_.max_error, *shown.errors) <= 1;
  }
  sink_->Take(shown);
}

GaitSolution InSiWhenCut(const GaitSpec& request, const GaitSpec& own, const Units& units, GaitSolution solution,
                         Termination cut, const std::optional<GaitSolution>& newest) {
  if (IsComplete(own, solution) || (!Converged(solution.termination) && !newest)) {
    return InSi(units, request, std::move(solution));
  }
  const bool has_errors_to_offer = newest && newest->finer && !solution.finer;
  if (!Converged(solution.termination) || has_errors_to_offer) {
    GaitSolution taken = *newest;
    const double excess = ExcessSmoothing(own, taken);
    if (excess > 0)
      taken.unmet_constraints.insert(taken.unmet_constraints.begin(), {"power smoothing", 0, 0, excess, "W"});
    taken.message = Explain(cut) + Describe(own, taken);
    taken.meshes = std::move(solution.meshes);
    taken.wall_time = solution.wall_time;
    solution = std::move(taken);
  } else {
    solution.message = Explain(cut) + " " + solution.message;
  }
  solution = InSi(units, request, std::move(solution));
  solution.termination = cut;
  return solution;
}

}  // namespace rollgait
