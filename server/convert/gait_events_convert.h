#ifndef ROLLGAIT_SERVER_CONVERT_GAIT_EVENTS_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_GAIT_EVENTS_CONVERT_H_

#include "core/models/scene.h"
#include "core/validation/gait_events.h"
#include "rollgait/v1/gait_events.pb.h"

namespace rollgait::server {

// `scene` is the one that the events were measured in.
v1::GaitEvents EncodeGaitEvents(const GaitEvents& events, const Scene& scene);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_GAIT_EVENTS_CONVERT_H_
