// The service's joints and axes in the words of OpenSim's gait models.
#ifndef ROLLGAIT_CLIENT_FORMATS_OPENSIM_COORDINATES_H_
#define ROLLGAIT_CLIENT_FORMATS_OPENSIM_COORDINATES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// OpenSim's axes: X forward, Y up, Z right. (X, Y, Z) = (x, z, −y) of the service.
Eigen::Vector3d ToOpensim(const Eigen::Vector3d& v);
// A rotation between two frames whose axes are both renamed so.
Eigen::Matrix3d ToOpensim(const Eigen::Matrix3d& rotation);

// A coordinate of the .osim: its value is `sign` times the position of the joint; velocities and efforts likewise.
struct OpensimCoordinate {
  std::string name;
  double sign;
};

// One for each of Model.joints. Joints of a human have the names of OpenSim's gait models where they turn about the
// same axis ("hip_flexion_r"; docs/reference/formats.md has the table); others keep theirs.
std::vector<OpensimCoordinate> OpensimCoordinates(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_OPENSIM_COORDINATES_H_
