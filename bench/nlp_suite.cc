// The programs of tests/core/nlp/suite through the solver of core/nlp and through Ipopt: nlp_suite [NAME ...]
// One line a program: its size, how each solver ends (R: ours ended by Ipopt) after how many iterations, our objective,
// and how far it is from Ipopt's and from the value that is published, relative where that is above 1. Of an infeasible
// program the sum of the violations stands in place of the objective.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "tests/core/nlp/suite/measure.h"
#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {
namespace {

const char* NameOf(Termination termination) {
  switch (termination) {
    case Termination::kOptimal:
      return "optimal";
    case Termination::kAcceptable:
      return "acceptable";
    case Termination::kInfeasible:
      return "infeasible";
    case Termination::kIterationLimit:
      return "limit";
    default:
      return "difficulty";
  }
}

void Print(const SuiteRow& row) {
  const auto program = row.make();
  const NlpResult ours = SolveNlp(*program, StartOf(row), SuiteOptions(), {});
  const NlpResult ipopt = SolveWithIpopt(*program, StartOf(row), SuiteOptions(), {});
  const double value = ValueOf(*program, ours);
  std::printf("| %-27s | %3d | %3d | %-10s%s %4d | %-10s %4d | %17.10g | %8.1e |", row.name.c_str(),
              program->variables(), program->constraints(), NameOf(ours.termination),
              ours.restored_from >= 0 ? " R" : "  ", ours.iterations, NameOf(ipopt.termination), ipopt.iterations,
              value, DistanceBetween(value, ValueOf(*program, ipopt)));
  if (!row.answer.values.empty()) std::printf(" %8.1e", DistanceTo(row.answer.values, value));
  std::printf("%s\n", row.answer.values.empty() ? "          |" : " |");
}

}  // namespace
}  // namespace rollgait::suite

int main(int argc, char** argv) {
  const std::vector<std::string> asked(argv + 1, argv + argc);
  std::printf("| program | n | m | ours | Ipopt | value | from Ipopt's | from the published |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const rollgait::suite::SuiteRow& row : rollgait::suite::SuiteRows()) {
    if (asked.empty() || std::find(asked.begin(), asked.end(), row.name) != asked.end()) rollgait::suite::Print(row);
  }
  return 0;
}
