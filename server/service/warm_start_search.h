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

// How far apart two requests are in 1° of slope and 0.05 m/s of prescribed speed, together as a length; nothing if one
// prescribes a speed and the other does not.
std::optional<double> WarmStartDistance(const v1::SolveSpec& a, const v1::SolveSpec& b);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_WARM_START_SEARCH_H_
