// Events, support and the ground's force on each foot for the page, as the server measured them.
#ifndef ROLLGAIT_CLIENT_REPORT_GAIT_EVENTS_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_GAIT_EVENTS_DATA_H_

#include <nlohmann/json.hpp>

#include "rollgait/v1/gait_events.pb.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// Steps of the curves in rollgait.v1.FootOnGround.
inline constexpr int kCycleSteps = 200;

// Throws Failure(kUsage) if the curves of the foot do not have kCycleSteps + 1 instants.
void RequireInstants(const v1::FootOnGround& foot);

// {phases: [{start, end, contacts, feet}]     contacts by name, feet: how many
//  events: [{percent, foot, name}]            foot "right" or "left", name as EventName
//  feet: [{name, right, stance, normal, along, sideways, vertical, forward, pressure}]
//          stance 0 … 1; lists in % of body weight: normal to the ground, along +x and +y, and in axes that gravity
//          gives; pressure: centre of pressure along x after its first place in the stance of this instant, mm, null
//          where it is none
//  double_support, flight}                    0 … 1
// Lists are empty and double_support null without events (of an older server).
nlohmann::json GaitEventsData(const v1::GaitEvents& events, const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_GAIT_EVENTS_DATA_H_
