// Contact kinematics of every kind of surface asks for no memory.
#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/pair_hessians.h"
#include "core/geometry/flattened_superellipsoid.h"
#include "tests/support/allocation_counter.h"

namespace rollgait {
namespace {

TEST(PairAllocationTest, NoneInAnyCall) {
  const Surface surfaces[] = {Ellipsoid({0.3, 0.2, 0.4}), Sphere(0.3), Superellipsoid(Vector3(0.3, 0.2, 0.4), 0.6, 1.2),
                              FlattenedSuperellipsoid::Create({0.3, 0.2, 0.4}, 0.6, 0.8, 0.05).value()};
  FrameMotion body_1, body_2;
  body_1.w_WB = Vector3(1, 2, 3);
  const PlacedPlane plane{Vector3::Zero(), Vector3(0.48, 0.6, 0.64)};
  for (const Surface& surface : surfaces) {
    const PlacedSurface one{surface, Vector3::Zero(), Matrix3::Identity()};
    const PlacedSurface two{Ellipsoid({0.2, 0.5, 0.3}), Vector3::Zero(), Matrix3::Identity()};
    SurfacePair pair(one, two);
    const long before = Allocations();
    double sum = 0;
    for (const double distance : {2.0, 0.3}) {  // apart, and overlapping: the search for a separating plane runs, too
      body_2.p_WB = distance * Vector3(0.48, 0.6, 0.64);
      pair.Restart();
      sum += pair.Compute(body_1, body_2).gap;
      sum += ComputeSurfacePairDerivatives(one, body_1, two, body_2, pair.separation(), 2).gap[0];
      sum += ComputePlaneContact(one, body_1, plane, body_2).gap;
      sum += ComputePlaneDerivatives(one, body_1, plane, body_2, 2).gap[0];
      const PairHessians on_plane = PairHessians::OnPlane(one, body_1, plane, body_2);
      const PairHessians pairs = PairHessians::OfSurfaces(one, body_1, two, body_2, pair.separation());
      for (const PairHessians* hessians : {&on_plane, &pairs}) {
        ASSERT_TRUE(hessians->exist());
        sum += hessians->GapAcceleration()(3, 4) + hessians->Drift(body_2.p_WB)(3, 4);
      }
    }
    EXPECT_EQ(Allocations() - before, 0);
    EXPECT_TRUE(std::isfinite(sum));
  }
  const long before = Allocations();
  ::operator delete(::operator new(1));  // unlike a new expression, no compiler may leave it out
  EXPECT_GT(Allocations(), before);      // the counter counts
}

}  // namespace
}  // namespace rollgait
