#ifndef ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_EXPECT_KNOWN_ANSWER_H_
#define ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_EXPECT_KNOWN_ANSWER_H_

#include "tests/core/known_answers/solve_known.h"

namespace rollgait {

// Expects of every run that all of its solves end at an optimum, that its error is within its bar, and, as the run
// says, that error and bar are what was asked and that the error falls with the order. Of the last run that reaches
// what was asked, that Ipopt ends at the same objective. Returns the solutions of that run.
KnownError ExpectKnownAnswer(const KnownProblem& known);

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_EXPECT_KNOWN_ANSWER_H_
