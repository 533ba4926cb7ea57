#ifndef ROLLGAIT_CORE_GAIT_TIME_UNIT_H_
#define ROLLGAIT_CORE_GAIT_TIME_UNIT_H_

#include "core/gait/gait_solver.h"

namespace rollgait {

// Walks are solved in a time unit in which gravity is 9.81 (GaitSpec::similarity.time()): then walks of equal Froude
// number are the same numbers to the solver, with the same iterations, whatever the planet. Units of mass and length
// stay. A quantity of dimension T^k is multiplied by unit^−k before the solve, and divided by it afterwards.

// The same walk with `unit` s for 1 s. Objective, contributions of its terms and scaled rows of the NLP stay what they
// are. Contract: unit > 0, no manoeuvre. Bounds of accuracy that mix dimensions take the stricter of the two.
GaitSpec InTimeUnit(double unit, const GaitSpec& spec);
Trajectory InTimeUnit(double unit, Trajectory trajectory);

// What Solve of InTimeUnit(unit, spec) gave, in seconds, judged by the bounds of `spec`. Multipliers stay those of the
// NLP that was solved; it is the same one whenever a solution of the spec's gravity is the start of another.
GaitSolution InSeconds(double unit, const GaitSpec& spec, GaitSolution solution);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_TIME_UNIT_H_
