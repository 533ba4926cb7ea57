// Eq. (2.1): contact points as the minimum of ½ |x₁ − x₂|². That is the distance of separated bodies; of overlapping
// ones it is 0 and the points are not unique. The library's gap is signed: n · (c − o) − h(−n).
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/paper/rolling_tree.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// The gap of the tree's ellipsoid when its root is moved up by `height`, and the printed minimum, by sampling the body.
struct Distances {
  double gap, printed;
};

Distances At(double height) {
  const RollingTree tree;
  BodyDynamics::State state = tree.StateAt(0);
  state.back().p_WL.z() += height;
  const BodyDynamics::Link& link = state.back();
  SeededRandom random(21);
  double least = kInfinity;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 x = random.Uniform(0, 1) < 0.5 ? random.Unit() : Vector3(random.Uniform(0, 1) * random.Unit());
    const Vector3 p =
        link.p_WL + link.R_WL * (tree.surface.p_LE +
                                 tree.surface.R_LE * tree.surface.surface.ellipsoid()->semi_axes().cwiseProduct(x));
    least = std::min(least, std::max(p.z(), 0.0));  // distance to the half-space z <= 0
  }
  return {ComputeRollingContact(tree.surface, state).gap, least};
}

TEST(Equation2_1, IsTheGapOfSeparatedBodiesOnly) {
  const double gap = At(0).gap;
  const Distances separated = At(0.5 - gap), overlapping = At(-0.5 - gap);
  EXPECT_NEAR(separated.gap, 0.5, 1e-12);
  // The best of 10000 samples of the surface is a hundredth of a radian away: 1e-4 of the radii of curvature (5 m).
  EXPECT_NEAR(separated.printed, 0.5, 5e-3);
  EXPECT_NEAR(overlapping.gap, -0.5, 1e-12);
  EXPECT_EQ(overlapping.printed, 0);
}

}  // namespace
}  // namespace rollgait
