// A stride as curves and as frames of a stick figure.
#ifndef ROLLGAIT_CLIENT_REPORT_WALKER_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_WALKER_DATA_H_

#include <nlohmann/json.hpp>

#include "client/report/stride.h"

namespace rollgait::client {

// What the page shows of the model: {name, description, mass, stature, leg_length, gravity, joints: [...], sources:
// [...]}.
nlohmann::json ModelData(const v1::Model& model);

// {duration, displacement, percent: [...],
//  contacts: [{name, right}],
//  angles, torques, powers: [{joint, title, positive, values}],                °, N m, W of the joints shown
//  walker: {points: [[x0, z0, x1, z1, …] per sample], segments: [[from, to, side]], feet: [[cx, cz, a, b, angle, px,
//  pz,
//           fx, fz] per contact and sample], center: [[x, z] per sample], height}}   m, % of body weight
// Joints shown: hip_r, knee_r and ankle_r where they exist, else every actuated joint of the reference side, else every
// actuated joint; angles also of the unactuated revolute joints. side: 0 middle, 1 reference side, 2 other side.
nlohmann::json StrideData(const Stride& stride, const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_WALKER_DATA_H_
