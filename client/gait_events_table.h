// Events and support of a gait in words.
#ifndef ROLLGAIT_CLIENT_GAIT_EVENTS_TABLE_H_
#define ROLLGAIT_CLIENT_GAIT_EVENTS_TABLE_H_

#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/gait_events.pb.h"

namespace rollgait::client {

// "heel strike", "foot flat", "heel off", "toe off"; "right", "left".
std::string EventName(v1::GaitEvent::Kind kind);
std::string SideName(v1::Foot foot);

// % of the first such event; empty if there is none.
std::optional<double> FirstEvent(const v1::GaitEvents& events, v1::GaitEvent::Kind kind, v1::Foot foot);

// Name and value: the stride, stance and events of each foot, double support, and flight if there is any. Empty without
// events.
std::vector<std::vector<std::string>> GaitEventRows(const v1::GaitEvents& events);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_GAIT_EVENTS_TABLE_H_
