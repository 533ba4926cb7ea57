// Virtual markers: three on every link with mass, so that its pose follows from them.
#ifndef ROLLGAIT_CLIENT_FORMATS_BODY_MARKERS_H_
#define ROLLGAIT_CLIENT_FORMATS_BODY_MARKERS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

struct BodyMarker {
  std::string name;
  int joint;                 // index of the joint whose link carries it
  Eigen::Vector3d location;  // m, link frame
};

// "thigh_r_joint": the origin of the link, which is the centre of its joint. "thigh_r_front" and "thigh_r_left": 0.1 m
// ahead of the link's centre of mass, and to the left of it.
std::vector<BodyMarker> BodyMarkers(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_BODY_MARKERS_H_
