// The shapes that a body is drawn with: its own surfaces, and for links that have none a shape for the eye.
#ifndef ROLLGAIT_CLIENT_REPORT_BODY_SHAPES_H_
#define ROLLGAIT_CLIENT_REPORT_BODY_SHAPES_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "client/report/kinematics.h"
#include "client/report/sides.h"
#include "client/report/surface_shape.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

enum class ShapeKind {
  kContact,  // a surface that touches the ground
  kBody,     // another surface of the model
  kDrawn,    // no part of the model: drawn so that a person sees a person
};

struct BodyShape {
  std::string part;  // "right shank"
  int joint;         // index of the joint whose link carries it
  Pose pose;         // of the shape's axes in the link frame
  Eigen::Vector3d semi_axes;
  Side side;
  ShapeKind kind;
  std::optional<SupportNorm> form;  // of the shape divided by its semi-axes; without it an ellipsoid
};

// Contacts come first, in the order of Model.contacts. The link that carries the upper end of the body gets a head
// whose top is at stature height in the upright posture (zero posture, hips at leg length over the ground). Without a
// stature, as in own models, a link in the middle is an ellipsoid around its joints and centre of mass. Throws
// Failure(kUsage) for a surface on no joint of the model.
std::vector<BodyShape> BodyShapes(const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_BODY_SHAPES_H_
