// The solves of a command that makes many: making them and following them to their ends.
#ifndef ROLLGAIT_CLIENT_SWEEP_SOLVE_GROUP_H_
#define ROLLGAIT_CLIENT_SWEEP_SOLVE_GROUP_H_

#include <functional>
#include <string>
#include <vector>

#include "client/connection.h"
#include "client/sweep/leave.h"
#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::client {

// As CreateInBatches, and those that were attached to and had ended without an answer once more.
std::vector<v1::Solve> CreateAgain(Connection& connection, std::vector<v1::CreateSolveRequest> requests,
                                   const std::function<void(double seconds)>& wait);

// Follows all solves, several streams one after the other if need be. Calls `on_event` with the place of the solve in
// `solves`, for its newest event and what follows. Throws as GroupFollower::Follow.
void FollowAll(Connection& connection, const std::vector<v1::Solve>& solves, double reconnect_s, Leave& leave,
               const std::function<void(size_t place, const v1::SolveEvent&)>& on_event,
               const std::function<void(const std::string&)>& on_note);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_SOLVE_GROUP_H_
