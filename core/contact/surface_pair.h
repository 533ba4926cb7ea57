#ifndef ROLLGAIT_CORE_CONTACT_SURFACE_PAIR_H_
#define ROLLGAIT_CORE_CONTACT_SURFACE_PAIR_H_

#include "core/contact/pair_kinematics.h"
#include "core/contact/pair_separation.h"

namespace rollgait {

PosedSurface Pose(const PlacedSurface& placed, const FrameMotion& body);

// The kinematics of the contact points that a separation gives; the accelerations of the frames as in PairKinematics.
// Source: contact-math 8.
PairKinematics ComputeSurfaceContact(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                     const PlacedSurface& surface_2, const FrameMotion& body_2,
                                     const Separation& separation);

// The contact of two bodies, followed in time: every call starts from the normal of the last one. While the bodies
// overlap it stays on the branch of local maxima that it came in on; when that branch ends or the bodies part, it goes
// to the distance. One object a thread. No allocation.
class SurfacePair {
 public:
  SurfacePair(const PlacedSurface& surface_1, const PlacedSurface& surface_2)
      : surface_1_(surface_1), surface_2_(surface_2) {}

  PairKinematics Compute(const FrameMotion& body_1, const FrameMotion& body_2);

  // Of the last Compute: distance, steps, convergence, and whether the bodies overlap.
  const Separation& separation() const { return separation_; }
  // The next call starts cold; or from this unit normal (world, from body 1 to body 2).
  void Restart() { warm_ = false; }
  void StartFrom(const Vector3& nu);

  const PlacedSurface& surface_1() const { return surface_1_; }
  const PlacedSurface& surface_2() const { return surface_2_; }

 private:
  PlacedSurface surface_1_, surface_2_;
  Separation separation_;
  bool warm_ = false;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_SURFACE_PAIR_H_
