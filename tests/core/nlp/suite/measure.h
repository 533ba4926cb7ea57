#ifndef ROLLGAIT_TESTS_CORE_NLP_SUITE_MEASURE_H_
#define ROLLGAIT_TESTS_CORE_NLP_SUITE_MEASURE_H_

#include <vector>

#include "core/nlp/nlp_options.h"
#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {

// How every program of the suite is solved: cold, to 1e-8.
NlpStart StartOf(const SuiteRow& row);
NlpOptions SuiteOptions();

// Σ of what g(x) is beyond the bounds of rows.
double SumOfViolations(NlpProblem& program, const VectorX& x);

// What Answer::values are about: the objective, or the sum of violations where the solve ended as infeasible.
double ValueOf(NlpProblem& program, const NlpResult& result);

// |a − b| / max(1, |b|).
double DistanceBetween(double a, double b);
// From the nearest one. Contract: there is one.
double DistanceTo(const std::vector<double>& values, double value);

}  // namespace rollgait::suite

#endif  // ROLLGAIT_TESTS_CORE_NLP_SUITE_MEASURE_H_
