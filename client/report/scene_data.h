// A motion as the page's three-dimensional scene draws it.
#ifndef ROLLGAIT_CLIENT_REPORT_SCENE_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_SCENE_DATA_H_

#include <nlohmann/json.hpp>
#include <vector>

#include "client/report/motion.h"
#include "rollgait/v1/gait_events.pb.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// {shapes: [{part, link, center: [x, y, z], rotation: [w, x, y, z], axes: [a, b, c], side, kind}],
//  links:    how many; each has seven rows of `poses` from 7 · link on: x, y, z, then the quaternion w, x, y, z
//            (link -> world), which passes from sample to sample without a change of sign
//  poses:    PackedRows of every second instant
//  contacts: [{name, side, shape, rows}]   rows: first of eight rows of `tracks`: the point on the ground x, y; the
//            same point in the axes of the contact's ellipsoid x, y, z; the force on the body x, y, z
//  feet:     [{side, rows}]                two rows of `tracks`: centre of pressure x, y
//  center:   first of three rows of `tracks`: centre of mass
//  tracks:   PackedRows of every instant; not finite where there is no contact
//  height}                                 of the highest point of a shape
// Metres, world axes; x = 0 is where the centre of mass begins if it is made to go evenly. Forces in % of body weight.
// link counts the links that carry shapes. side, kind: the numbers of Side and ShapeKind. The number of instants must
// be odd; feet is empty without events.
nlohmann::json SceneData(const std::vector<Instant>& instants, const v1::Model& model, const v1::GaitEvents& events);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_SCENE_DATA_H_
