// The ground's force on the body as a force plate under each foot would record it.
#ifndef ROLLGAIT_CLIENT_FORMATS_GROUND_REACTION_H_
#define ROLLGAIT_CLIENT_FORMATS_GROUND_REACTION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "client/report/stride.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Contacts whose forces are summed: those of a foot, or of one link.
struct Plate {
  std::string name;           // "right", "left", the name of a link, or of a contact
  std::vector<int> contacts;  // indices in Model.contacts
  int joint;                  // whose link the force acts on; -1: on several links
};

// The feet of GaitEvents, right then left; without events every contact by itself. Throws Failure(kUsage) for a contact
// that the model does not have.
std::vector<Plate> FootPlates(const v1::Solve& solve);

// The same, with a foot that has its contacts on several links (toes) divided into them: forces act on bodies.
std::vector<Plate> LinkPlates(const v1::Solve& solve);

// World axes of the service. Force, point and couple together are exactly the contacts' forces at their lowest points.
struct Reaction {
  Eigen::Vector3d force;   // N, on the body
  Eigen::Vector3d point;   // m, on the ground z = 0: the centre of pressure
  Eigen::Vector3d couple;  // N m, about `point`; the free moment along z, and nothing else where the foot bears weight
};

// At each sample of the stride. In swing force and couple are zero, and the point is the last one of the stance before
// (before the first stance: the first one after). Where the normal force is less than 1e-3 N, no centre of pressure is
// defined: the point is that of the first contact on the ground, and the couple has what is left.
std::vector<Reaction> Reactions(const Stride& stride, const v1::Model& model, const Plate& plate);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_GROUND_REACTION_H_
