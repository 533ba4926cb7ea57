// What a body looks like in formats that show one: ellipsoids on its links.
#ifndef ROLLGAIT_CLIENT_FORMATS_LINK_SHAPES_H_
#define ROLLGAIT_CLIENT_FORMATS_LINK_SHAPES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

struct LinkShape {
  enum class Kind {
    kContact,  // rolls on the ground: Model.contacts
    kBody,     // has a thickness that others must not overlap: Model.bodies
    kInertia,  // to look at only: the homogeneous ellipsoid with the link's mass and inertia
  };
  Kind kind;
  std::string name;           // unique in the model; of kInertia the link's name and "_inertia"
  int joint;                  // index of the joint whose link carries it
  Eigen::Vector3d center;     // m, link frame
  Eigen::Matrix3d rotation;   // its principal axes -> link
  Eigen::Vector3d semi_axes;  // m
};

// The contacts, the bodies under names that no contact has, and the inertia of every link with mass that carries
// neither. Throws Failure(kUsage) for a surface that is not an ellipsoid or is on no joint.
std::vector<LinkShape> LinkShapes(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_LINK_SHAPES_H_
