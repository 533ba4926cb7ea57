#ifndef ROLLGAIT_TESTS_CORE_NLP_SUITE_SUITE_ROW_H_
#define ROLLGAIT_TESTS_CORE_NLP_SUITE_SUITE_ROW_H_

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/nlp/result.h"
#include "tests/core/nlp/suite/formula_program.h"

namespace rollgait::suite {

// Whether SolveNlp enters its restoration phase. kByRounding: it depends on the compiler and its options, the row says
// which.
enum class Restores { kNo, kYes, kByRounding };

// How the solvers are expected to end on a program, and where. What a solver cannot do stands here.
struct Answer {
  // The published optimal value, and what else is a local minimum (why says so). Of an infeasible program: the sum of
  // the violations at its minimiser of infeasibility. Empty: nothing is published, the solvers are compared.
  std::vector<double> values;
  // Within this of a value, relative where that is above 1. 1e-6: solves end with an error of 1e-8, and the digits
  // that are published are eight or more. Anything larger has its reason in why.
  double tolerance = 1e-6;
  std::string why = "";
  Termination ours = Termination::kOptimal;   // of SolveNlp
  Termination ipopt = Termination::kOptimal;  // of Ipopt alone
  Restores restores = Restores::kNo;
  bool is_taken_over = false;  // SolveNlp ends by Ipopt
};

struct SuiteRow {
  std::string name;
  std::function<std::unique_ptr<NlpProblem>()> make;
  std::vector<double> start;
  Answer answer;
};

// The same interval for all.
std::vector<Interval> Each(int n, const Interval& interval);

// A row of a formula.
SuiteRow Row(const std::string& name, const std::vector<double>& start, const std::vector<Interval>& variables,
             const std::vector<Interval>& rows, const Formula& formula, const Answer& answer);

// The parts of the suite; SuiteRows is all of them. Each of their files says where its problems are published.
std::vector<SuiteRow> HockSchittkowskiSmall();
std::vector<SuiteRow> HockSchittkowskiLarge();
std::vector<SuiteRow> CuteRows();
std::vector<SuiteRow> DegenerateRows();
std::vector<SuiteRow> InfeasibleRows();
std::vector<SuiteRow> ChainRows();
std::vector<SuiteRow> SuiteRows();

}  // namespace rollgait::suite

#endif  // ROLLGAIT_TESTS_CORE_NLP_SUITE_SUITE_ROW_H_
