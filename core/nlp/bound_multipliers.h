#ifndef ROLLGAIT_CORE_NLP_BOUND_MULTIPLIERS_H_
#define ROLLGAIT_CORE_NLP_BOUND_MULTIPLIERS_H_

#include "core/nlp/newton_step.h"
#include "core/nlp/nlp_options.h"

namespace rollgait {

// Multipliers of the bounds of w at the first point: 1 of a cold start; of a warm one those of `start`, and of its rows
// for slacks (multipliers->y), but no smaller than on the central path at the point's distances; those of the central
// path where they are to be estimated (NlpOptions).
void StartBoundMultipliers(const BarrierProblem& barrier, const BarrierProblem::Point& point, double mu,
                           const NlpStart& start, bool estimate, Multipliers* multipliers);

// Newton step of the multiplier z of a distance that changes by `move`.
inline double MultiplierStep(double distance, double z, double move, double mu) {
  return mu / distance - z - z / distance * move;
}

// The same of all bounds of w for a step in w; 0 where there is no bound.
void StepBoundMultipliers(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                          const Multipliers& multipliers, const VectorX& move, double mu, Multipliers* step);

// z, or the nearest number within a factor of 1e10 of the multiplier on the central path (Wächter and Biegler, eq. 16).
double NearCentralPath(double distance, double z, double mu);

// Keeps all of them there.
void KeepNearCentralPath(const BarrierProblem& barrier, const BarrierProblem::Point& point, double mu,
                         Multipliers* multipliers);

// After a move in w that was found without them: their Newton step for that move, as long as they stay positive by τ;
// all 1 if one is larger than `most` then.
void MoveBoundMultipliers(const BarrierProblem& barrier, const BarrierProblem::Point& from,
                          const BarrierProblem::Point& to, double mu, double tau, double most,
                          Multipliers* multipliers);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_BOUND_MULTIPLIERS_H_
