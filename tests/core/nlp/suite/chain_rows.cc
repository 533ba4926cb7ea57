// Random programs with the structure of optimal control. Nothing is published about them: the solvers are compared.
#include "tests/core/nlp/suite/chain_program.h"
#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {
namespace {

SuiteRow Chain(const std::string& name, const ChainProgram::Kind& kind, const Answer& answer) {
  const std::vector<double> start(ChainProgram(kind).variables(), 0.1);
  return {name, [kind] { return std::make_unique<ChainProgram>(kind); }, start, answer};
}

}  // namespace

std::vector<SuiteRow> ChainRows() {
  const Answer alike;
  // The controls are too weak to bring the state so far.
  Answer out_of_reach;
  out_of_reach.ours = out_of_reach.ipopt = Termination::kInfeasible;
  out_of_reach.restores = Restores::kYes;
  return {
      Chain("chain 1", {1, 10}, alike),
      Chain("chain 2, final state", {2, 20, 0, 0.1, true, 0}, alike),
      Chain("chain 3, not convex", {3, 30, 1.5, 0.2}, alike),
      Chain("chain 4, not convex, final", {4, 20, 1.5, 0.2, true, 0.2}, alike),
      Chain("chain 5, 100 stages", {5, 100, 0.5, 0.3}, alike),
      Chain("chain 6, out of reach", {6, 5, 0, 0.1, true, 50}, out_of_reach),
  };
}

}  // namespace rollgait::suite
