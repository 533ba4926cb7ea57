#ifndef ROLLGAIT_SERVER_CONVERT_SURFACE_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_SURFACE_CONVERT_H_

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/geometry/surface.h"
#include "rollgait/v1/surface.pb.h"

namespace rollgait::server {

// What no message can say, an implicit surface or a centre away from the origin, leaves the shape unset; the client
// refuses to draw such a surface. No model that walks has one.
void EncodeSurface(const Surface& surface, v1::Surface* encoded);

// Any surface that a message can say; nothing if it was refused. Violations name `field` and its members.
std::optional<Surface> DecodeSurface(const std::string& field, const v1::Surface& surface, Violations* violations);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_SURFACE_CONVERT_H_
