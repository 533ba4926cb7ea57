// The programs of tests/core/nlp/suite through the solver of core/nlp and through Ipopt: nlp_suite [--iterations] [NAME
// ...] One line a program: its size, how each solver ends (r: ours restored feasibility, I: Ipopt took over from ours)
// after how many iterations, our objective, and how far it is from Ipopt's and from the value that is published,
// relative where that is above 1. Of an infeasible program the sum of the violations stands in place of the objective.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "core/nlp/termination.h"
#include "tests/core/nlp/suite/measure.h"
#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {
namespace {

void PrintIteration(const IterationInfo& info) {
  std::printf("%4d%s %14.7e %8.1e %8.1e %8.1e %8.1e %8.1e %8.1e %8.1e %d\n", info.index, info.restoration ? "r" : " ",
              info.objective, info.primal_infeasibility, info.dual_infeasibility, info.barrier_parameter,
              info.step_norm, info.regularization, info.primal_step, info.dual_step, info.line_search_trials);
}

void Print(const SuiteRow& row, bool iterations) {
  const auto program = row.make();
  bool restores = false;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) {
    restores = restores || info.restoration;
    if (iterations) PrintIteration(info);
  };
  const NlpResult ours = SolveNlp(*program, StartOf(row), SuiteOptions(), control);
  const NlpResult ipopt = SolveWithIpopt(*program, StartOf(row), SuiteOptions(), {});
  const double value = ValueOf(*program, ours);
  std::printf("| %-27s | %3d | %3d | %-10s%s %4d | %-10s %4d | %17.10g | %8.1e |", row.name.c_str(),
              program->variables(), program->constraints(), WordOf(ours.termination),
              ours.restored_from >= 0 ? " I"
              : restores              ? " r"
                                      : "  ",
              ours.iterations, WordOf(ipopt.termination), ipopt.iterations, value,
              DistanceBetween(value, ValueOf(*program, ipopt)));
  if (!row.answer.values.empty()) std::printf(" %8.1e", DistanceTo(row.answer.values, value));
  std::printf("%s\n", row.answer.values.empty() ? "          |" : " |");
}

}  // namespace
}  // namespace rollgait::suite

int main(int argc, char** argv) {
  std::vector<std::string> asked(argv + 1, argv + argc);
  const bool iterations = !asked.empty() && asked[0] == "--iterations";
  if (iterations) asked.erase(asked.begin());
  std::printf("| program | n | m | ours | Ipopt | value | from Ipopt's | from the published |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const rollgait::suite::SuiteRow& row : rollgait::suite::SuiteRows()) {
    if (asked.empty() || std::find(asked.begin(), asked.end(), row.name) != asked.end()) {
      rollgait::suite::Print(row, iterations);
    }
  }
  return 0;
}
