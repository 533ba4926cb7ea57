// A model made symmetric: what construction drawings of left and right round differently.
#ifndef ROLLGAIT_CLIENT_IMPORT_MIRROR_AVERAGE_H_
#define ROLLGAIT_CLIENT_IMPORT_MIRROR_AVERAGE_H_

#include <string>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// The largest change that averaging made to any link.
struct MirrorChange {
  double mass = 0;     // share of the link's mass
  double center = 0;   // m
  double inertia = 0;  // Frobenius norm, share of the link's tensor
  double limits = 0;   // rad, m, N m, N, rad/s or m/s: the largest cut of a range, an effort or a velocity

  // "masses by up to 1.9 %, centres of mass by 0.4 mm, inertias by 3 %, limits by 0.01"
  std::string Describe() const;
  // True if no more than roundings of drawings: 5 % of mass, 20 mm, 25 % of inertia; limits do not count.
  bool IsSmall() const;
};

// Gives every link and its mirror image the mean of both masses, the centre of mass of both together and the mean of
// both inertias, all compared at position zero, and every joint and its image the narrower range and the lower limits.
// Joint frames stay. Contract: mirror_joint and mirror_sign are set, each image the other's.
MirrorChange AverageMirrorImages(v1::Model* model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MIRROR_AVERAGE_H_
