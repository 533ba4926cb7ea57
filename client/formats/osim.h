// A model as .osim, the XML of OpenSim 4.
#ifndef ROLLGAIT_CLIENT_FORMATS_OSIM_H_
#define ROLLGAIT_CLIENT_FORMATS_OSIM_H_

#include <string>

#include "client/formats/ground.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// Every link with mass is a Body with the link's name, its origin, and its axes renamed to OpenSim's (ToOpensim); the
// joints before it are one CustomJoint with the coordinates of OpensimCoordinates. A CoordinateActuator for each
// actuated joint (optimal force 1, so that its control is the effort), the markers of BodyMarkers, and the surfaces as
// ellipsoids to look at. Throws Failure(kUsage) as BodyLinks, ToCustomJoint and LinkShapes.
std::string ToOsim(const v1::Model& model, const Ground& ground);

// Of a coordinate without range, in m or rad: OpenSim asks for one.
constexpr double kOsimUnlimited = 100;

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_OSIM_H_
