// Motion, markers and external loads for OpenSim. Axes: X forward along the ground, Y its normal, Z right.
#ifndef ROLLGAIT_CLIENT_FORMATS_OPENSIM_MOTION_H_
#define ROLLGAIT_CLIENT_FORMATS_OPENSIM_MOTION_H_

#include <string>
#include <vector>

#include "client/formats/format_table.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Contract of all: the solve has a trajectory. All throw Failure(kUsage) where trajectory and model do not fit.

// Coordinates of ToOsim over time, .mot: degrees and metres.
std::string ToMot(const v1::Solve& solve);

// The ground's force on each foot, .mot: ground_force_r_vx … N, the centre of pressure ground_force_r_px … m, the free
// moment ground_torque_r_x … N m. Where a foot has contacts on several links, also for each link by its name.
std::string ToGroundReactionMot(const v1::Solve& solve);

// Which column of the ground reaction acts on which body; `data_file` is the name of ToGroundReactionMot's file.
std::string ToExternalLoads(const v1::Solve& solve, const std::string& data_file);

// The markers of ToOsim over time, mm.
std::string ToTrc(const v1::Solve& solve);

// model.osim, motion.mot, ground_reaction.mot, external_loads.xml, markers.trc.
std::vector<ExportedFile> ToOpensimFolder(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_OPENSIM_MOTION_H_
