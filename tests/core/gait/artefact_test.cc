#include "core/gait/artefact.h"

#include <gtest/gtest.h>

namespace rollgait {
namespace {

// A walk at 1.3 m/s with the given slip between nodes and share of the work that comes from nothing.
GaitSolution Walk(double slip, double energy) {
  GaitSolution solution;
  solution.speed = 1.3;
  solution.accuracy.emplace();
  solution.accuracy->max_slip = slip;
  solution.accuracy->energy_balance_error_relative = energy;
  return solution;
}

TEST(Artefact, SlipsOrLivesOnEnergyFromNothing) {
  GaitRequest request;
  request.body.model = "planar";
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_FALSE(IsArtefact(spec, Walk(0.25, 0.4)));
  EXPECT_TRUE(IsArtefact(spec, Walk(0.27, 0.0)));
  EXPECT_TRUE(IsArtefact(spec, Walk(0.0, 0.6)));
  EXPECT_FALSE(IsBeyondRefinement(spec, Walk(0.6, 0.6)));
  EXPECT_TRUE(IsBeyondRefinement(spec, Walk(0.7, 0.0)));
  EXPECT_FALSE(IsArtefact(spec, GaitSolution()));
}

}  // namespace
}  // namespace rollgait
