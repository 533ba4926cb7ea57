#ifndef ROLLGAIT_CORE_GAIT_OWN_UNITS_H_
#define ROLLGAIT_CORE_GAIT_OWN_UNITS_H_

#include "core/gait/gait_solver.h"

namespace rollgait {

// Walks are solved in units of their own (OwnUnits), in which gravity is 9.81, the body has 75 and the weights of the
// costs sum up to 1: then walks of equal Froude number are the same numbers to the solver, with the same iterations,
// whatever the planet and the mass. The unit of length stays. A quantity of dimension M^m T^k is multiplied by
// mass^−m time^−k before the solve, and divided by that afterwards.

// Of the spec's similarity.
Units OwnUnits(const GaitSpec& spec);

// The same walk with `units.time` s for 1 s and `units.mass` kg for 1 kg. Scaled rows of the NLP stay what they are;
// objective, contributions of its terms and multipliers are divided by `units.objective`. Contract: units > 0, no
// manoeuvre. Bounds of accuracy that mix dimensions take the stricter of the two.
GaitSpec InUnits(const Units& units, const GaitSpec& spec);
Trajectory InUnits(const Units& units, Trajectory trajectory);

// The same, but for a relative 5e-12: what depends on mass, gravity or weights is rounded to 11 digits. Walks that
// differ by rounding alone then are one, since the solver, where minima lie side by side, goes to another one with the
// last digit. Contract: the spec is in its own units.
GaitSpec WithoutRounding(const GaitSpec& spec);

// What Solve of InUnits(units, spec) gave, in SI units, judged by the bounds of `spec`. The rows of
// multipliers are those of the NLP that was solved, in natural sizes.
GaitSolution InSi(const Units& units, const GaitSpec& spec, GaitSolution solution);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_OWN_UNITS_H_
