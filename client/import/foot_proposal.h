// The feet that a side file proposes.
#ifndef ROLLGAIT_CLIENT_IMPORT_FOOT_PROPOSAL_H_
#define ROLLGAIT_CLIENT_IMPORT_FOOT_PROPOSAL_H_

#include <string>
#include <vector>

#include "client/import/foot_fit.h"
#include "rollgait/v1/model_side_file.pb.h"

namespace rollgait::client {

// A part of a foot that stands on the ground: what one joint of the leg moves, and no joint behind it.
struct StandingPart {
  int joint;  // the last joint of the leg that moves it
  Extent extent;
  v1::ContactSurface::FootPart part;
};

// The parts of a leg (its joints from the hip on) that stand on the ground where the leg hangs straight: what the last
// joint moves and, as of feet with toes, what joints before it move as far as that reaches as low, to 2 % of `leg` (m).
// One part is the whole foot; of several the first is the heel and the last the toes. Empty if what the last joint
// moves has no shapes.
std::vector<StandingPart> StandingParts(const LinkTree& tree, const TreePosture& posture, const std::vector<int>& chain,
                                        double leg);

// A contact on a link that is at `place` in the world.
v1::SideContact ContactOf(const std::string& name, const std::string& link, const Pose& place,
                          const FittedEllipsoid& foot);

// Feet do not pass through each other: adds each contact as a body, and pairs those of the left with those of the
// right. Mirror images whose semi-axes differ by rounding get the same ones, as they must.
void AddFeetPairs(v1::ModelSideFile* side);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_FOOT_PROPOSAL_H_
