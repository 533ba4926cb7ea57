#ifndef ROLLGAIT_SERVER_SERVICE_WARM_START_SEARCH_H_
#define ROLLGAIT_SERVER_SERVICE_WARM_START_SEARCH_H_

#include <optional>
#include <string>

#include "rollgait/v1/solve_spec.pb.h"
#include "server/base/outcome.h"
#include "server/service/gait_knowledge.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// The stored solve that a request starts from.
struct FoundWarmStart {
  std::string payload;   // wire::WarmStart
  std::string identity;  // equal for equal solutions: part of the key of what is started from it
};

// Looks for what SolveSpec.warm_start asks for among the solves of a tenant (nullopt: of all). Nothing: none is asked
// for, or "nearest" finds none that is near enough. kInvalidArgument, with the field "spec.warm_start": the name is of
// no solve, of one that did not end OPTIMAL, or of one that the request cannot start from.
Outcome<std::optional<FoundWarmStart>> FindWarmStart(SolveStore& store, const GaitKnowledge& knowledge,
                                                     const v1::SolveSpec& spec,
                                                     const std::optional<std::string>& tenant = std::nullopt);

// Where a request stands for `nearest`: with those that ask the same but for slope, motion, mesh, limits and start, and
// prescribe a speed if it does. Distances are counted in 1° of slope and 0.05 m/s of speed, and 5 is too far.
SolvePlace PlaceOf(const v1::SolveSpec& spec);

// Gives solves of a store that an older version wrote their places; returns how many had none.
Outcome<int> PlaceOldSolves(SolveStore& store);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_WARM_START_SEARCH_H_
