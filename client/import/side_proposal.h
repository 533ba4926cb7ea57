// A side file to begin with: what names, axes and shapes of a tree suggest.
#ifndef ROLLGAIT_CLIENT_IMPORT_SIDE_PROPOSAL_H_
#define ROLLGAIT_CLIENT_IMPORT_SIDE_PROPOSAL_H_

#include <string>
#include <vector>

#include "client/import/link_tree.h"
#include "rollgait/v1/model_side_file.pb.h"

namespace rollgait::client {

struct SideProposal {
  v1::ModelSideFile side;
  std::vector<std::string> reasons;  // why, a sentence each
  std::vector<std::string> missing;  // what the caller must add before it can be used
};

// For a robot that stands upright with straight legs where the file's joints are zero (or at the end of their range
// that is nearest to zero), its legs being the chains that reach lowest on each side:
//   name       that of the file, if a model can have it; else with "_" in place of what it must not have
//   base       turned so that the legs hang along −z (upright.h), then about z so that the left leg is in +y; of a
//   robot
//              drawn in a plane so that its knees bend backwards. BASE_PLANE if no joint moves out of the plane of x, z
//   locked     joints that mimic another, planar joints, joints that move no mass, joints without limits that are in no
//              leg and have no role
//   roles      of each leg's joints that turn within 60° of y: by "hip", "knee" and "ankle" in their names, else by
//              order; trunk, shoulder and elbow by name
//   contacts   one ellipsoid a foot (foot_fit.h), of feet with toes one each for both parts (foot_proposal.h)
//   mirror     by names and places; averaged if links that should be mirror images are not quite (mirror_average.h),
//   none if they
//              are not at all
SideProposal ProposeSideFile(const LinkTree& tree);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_SIDE_PROPOSAL_H_
