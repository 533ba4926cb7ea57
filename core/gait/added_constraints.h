#ifndef ROLLGAIT_CORE_GAIT_ADDED_CONSTRAINTS_H_
#define ROLLGAIT_CORE_GAIT_ADDED_CONSTRAINTS_H_

#include <vector>

#include "core/gait/gait_spec.h"
#include "core/ocp/problem.h"
#include "core/transcription/flat_side.h"
#include "core/validation/report.h"

namespace rollgait {

// Adds to `added` what a judged motion violates and a problem with more constraints would keep: range, velocity and
// effort of joints between the points of a phase. Returns whether anything is new. The problem is solved without these
// constraints first, since most of them never matter and each costs time.
bool AddViolated(const GaitSpec& spec, const Trajectory& trajectory, const AccuracyReport& report,
                 AddedConstraints* added);

// The same for the distances of pairs of bodies that overlap, unless the request has no bound on overlap.
bool AddOverlapping(const GaitSpec& spec, const AccuracyReport& report, AddedConstraints* added);

// What one flat side of a friction pyramid may cost before it gets an edge, in units of the objective: a thousandth of
// it, and no less than the tolerance of the solve leaves open. `typical`: CollocationNlp::typical_objective.
double LeastCostOfASide(const GaitSpec& spec, double objective, double typical);

// Gives each side that costs more than `least_cost`, in units of the objective, a new edge, at the multiple of 5° next
// to where the force meets the cone. Returns whether any edge is new: a side stays if that multiple is not inside it.
bool AddFrictionEdges(const std::vector<FlatSide>& sides, double least_cost, AddedConstraints* added);

// Adds the distances of these pairs (indices into Scene::pairs).
void KeepApart(const std::vector<int>& pairs, AddedConstraints* added);

// What a solve that starts from a guess begins with: the pairs of bodies that most walks would overlap.
AddedConstraints UsualConstraints(const GaitSpec& spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ADDED_CONSTRAINTS_H_
