#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

std::vector<KnownProblem> KnownProblems() {
  std::vector<KnownProblem> all;
  for (KnownProblem (*make)() : {&BlockMove, &BrysonDenham, &Brachistochrone, &MoonLander, &Goddard, &VanDerPol,
                                 &CartPole, &Hypersensitive, &FiveLinkBiped})
    all.push_back(make());
  return all;
}

}  // namespace rollgait
