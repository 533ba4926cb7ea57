// Solves made by as few calls as the server takes them in.
#ifndef ROLLGAIT_CLIENT_SWEEP_BATCHES_H_
#define ROLLGAIT_CLIENT_SWEEP_BATCHES_H_

#include <functional>
#include <vector>

#include "client/connection.h"
#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::client {

// Of one batch and of one stream; the server's limits are 256 and 4 MiB.
inline constexpr size_t kMostAtOnce = 256, kMostBytesAtOnce = 3 << 20;

// The solves of the requests, in their order: made, or attached to by their request_ids, which every request has. A
// batch that is too long with the stored models and warm starts that it names is sent in halves. One that the server is
// too busy for is sent once more after `wait` was called with the time that the server names. Throws Failure; what
// earlier batches have made stays.
std::vector<v1::Solve> CreateInBatches(Connection& connection, const std::vector<v1::CreateSolveRequest>& requests,
                                       const std::function<void(double seconds)>& wait);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_BATCHES_H_
