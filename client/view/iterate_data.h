// An iterate of a running solve as the page draws it.
#ifndef ROLLGAIT_CLIENT_VIEW_ITERATE_DATA_H_
#define ROLLGAIT_CLIENT_VIEW_ITERATE_DATA_H_

#include <nlohmann/json.hpp>

#include "client/report/stride.h"
#include "rollgait/v1/iterate.pb.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// The motion of the iterate as a function of time: straight lines between its samples, no velocities, efforts or
// forces. It refers to both messages. Throws Failure(kUsage) that names the field if the iterate does not fit itself or
// the model.
StrideSource IterateMotion(const v1::Iterate& iterate, const v1::Model& model);

// {index, mesh, stride: {duration, displacement, phases, feet, events, scene}}: members as in ReportData, the last
// three lists empty but for the scene. Throws as IterateMotion.
nlohmann::json IterateData(const v1::Iterate& iterate, const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_VIEW_ITERATE_DATA_H_
