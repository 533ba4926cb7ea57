#ifndef ROLLGAIT_TESTS_SUPPORT_DISPLACED_FRAMES_H_
#define ROLLGAIT_TESTS_SUPPORT_DISPLACED_FRAMES_H_

#include <vector>

#include "core/contact/pair_derivatives.h"
#include "core/contact/pair_tangent.h"
#include "core/geometry/flattened_superellipsoid.h"
#include "tests/support/extreme_contacts.h"
#include "tests/support/seeded_random.h"

namespace rollgait {

inline FrameMotion Displaced(const FrameMotion& body, const Vector3& shift, const Vector3& theta) {
  FrameMotion moved = body;
  moved.p_WB += shift;
  moved.R_WB = ExtremeContacts::Turn(theta) * body.R_WB;
  return moved;
}

inline FrameMotion RandomFrame(SeededRandom* random, const Vector3& at) {
  FrameMotion body;
  body.R_WB = ExtremeContacts::Turn(3 * random->Unit());
  body.p_WB = at;
  return body;
}

// One body of each kind, of about 1 m.
inline std::vector<Surface> SmoothBodies() {
  return {Ellipsoid({0.8, 1.2, 0.5}), Sphere(0.7),
          Surface(Ellipsoid({0.4, 0.6, 0.9})).Rounded(0.2).MovedTo({0.1, 0, 0.2}),
          FlattenedSuperellipsoid::Create({0.8, 0.9, 0.7}, 0.8, 0.9, 0.3).value()};
}

// Two bodies whose frames are `distance` apart, at random but not where S₁ + S₂ + d I is nearly singular: there the
// normal moves fast and differences say little.
struct TwoBodies {
  TwoBodies(const Surface& first, double distance, SeededRandom* random)
      : one{first, {0.1, 0.2, -0.1}, ExtremeContacts::Turn({0.3, -0.2, 0.5})},
        two{Ellipsoid({0.7, 0.5, 0.9}), {-0.2, 0.1, 0.3}, ExtremeContacts::Turn({-0.4, 0.6, 0.1})} {
    SurfacePair pair(one, two);
    for (double least = 0; least < 0.3;) {
      body_1 = RandomFrame(random, {0, 0, 0});
      body_2 = RandomFrame(random, distance * random->Unit());
      pair.Restart();
      pair.Compute(body_1, body_2);
      separation = pair.separation();
      least =
          PairTangent(Pose(one, body_1), Pose(two, body_2), separation.nu, separation.distance).curvature.minCoeff();
    }
  }

  PlacedSurface one, two;
  FrameMotion body_1, body_2;
  Separation separation;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_DISPLACED_FRAMES_H_
