// The paper's statements beside our figures.
#ifndef ROLLGAIT_CLIENT_PAPER_STATEMENTS_H_
#define ROLLGAIT_CLIENT_PAPER_STATEMENTS_H_

#include <string>
#include <vector>

#include "client/paper/slope_figures.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

enum class Agreement { kAgrees, kDisagrees, kOpen };  // kOpen: our figures do not decide it

struct Statement {
  std::string where;  // section, equation or figure of the paper
  std::string paper;  // what it says
  std::string ours;   // our figures
  Agreement agreement = Agreement::kOpen;
  std::string why;  // what the verdict rests on
};

// "agrees", "disagrees", "open".
std::string AgreementName(Agreement agreement);

// Carpentier, Del Prete, Mansard, Laumond, "An analytical model of rolling contact and its application to the modeling
// of bipedal locomotion" (IMA Conference on Mathematics of Robotics, 2015), statement by statement. The verdicts follow
// from the solves alone. `solves` are +10°, 0° and −10° in this order; a statement that needs a gait which was not
// found is open.
std::vector<Statement> CompareStatements(const std::vector<v1::Solve>& solves,
                                         const std::vector<SlopeFigures>& figures);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PAPER_STATEMENTS_H_
