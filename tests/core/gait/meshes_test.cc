#include "core/gait/meshes.h"

#include <gtest/gtest.h>

#include <vector>

namespace rollgait {
namespace {

const Mesh kMesh{{{0.5, 0.25, 0.25}, {0.4, 0.6}}};

// The interval of phase 1 at which the first ends moved by `change`.
Mesh Moved(double change) { return {{kMesh.fractions[0], {0.4 + change, 0.6 - change}}}; }

TEST(Meshes, ATrajectorysMeshIsReadFromTheTimesOfItsNodes) {
  Trajectory trajectory;
  trajectory.phases.resize(2);
  trajectory.phases[0].node_times = {0.1, 0.3, 0.4, 0.5};
  trajectory.phases[1].node_times = {0.5, 0.7, 1.0};
  const Mesh mesh = MeshOf(trajectory);
  EXPECT_TRUE(IsSameMesh(mesh, kMesh));
  EXPECT_NE(mesh.fractions, kMesh.fractions) << "rounded";
}

TEST(Meshes, TheIntervalsOfAllPhasesCount) { EXPECT_EQ(TotalIntervals(kMesh), 5); }

TEST(Meshes, AreTheSameUpToRounding) {
  EXPECT_TRUE(IsSameMesh(kMesh, Moved(1e-12)));
  EXPECT_FALSE(IsSameMesh(kMesh, Moved(1e-6)));
  EXPECT_FALSE(IsSameMesh(kMesh, Moved(-1e-6)));
  EXPECT_FALSE(IsSameMesh(kMesh, {{{0.5, 0.5}, {0.4, 0.6}}}));
  EXPECT_FALSE(IsSameMesh(kMesh, {{{0.5, 0.25, 0.25, 0}, {0.4, 0.6}}}));
}

TEST(Meshes, TheShortestIntervalOfAPhaseCounts) {
  EXPECT_FALSE(HasShorterIntervals(kMesh, kMesh));
  EXPECT_FALSE(HasShorterIntervals(Moved(-1e-12), kMesh));
  EXPECT_TRUE(HasShorterIntervals(Moved(-0.1), kMesh));
  EXPECT_FALSE(HasShorterIntervals(kMesh, Moved(-0.1)));
  EXPECT_TRUE(HasShorterIntervals(kMesh, {{{0.4, 0.3, 0.3}, {0.1, 0.9}}})) << "in the first phase";
}

TEST(Meshes, AsFineIsAsManyIntervalsInEveryPhase) {
  EXPECT_TRUE(IsAtLeastAsFine(kMesh, Moved(0.1)));
  EXPECT_TRUE(IsAtLeastAsFine({{{0.5, 0.25, 0.25}, {0.4, 0.3, 0.3}}}, kMesh));
  EXPECT_FALSE(IsAtLeastAsFine({{{0.5, 0.25, 0.2, 0.05}, {1}}}, kMesh));
}

}  // namespace
}  // namespace rollgait
