#include "tests/client/fake_filter.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <string>

namespace rollgait::client {

bool Passes(const v1::Solve& solve, const v1::ListSolvesRequest& request) {
  const v1::SolveFilter& filter = request.filter();
  const std::string& tenant = request.tenant();
  if (request.state() != v1::SOLVE_STATE_UNSPECIFIED && solve.state() != request.state()) return false;
  if (!tenant.empty() && tenant != "-" && solve.tenant() != tenant) return false;
  const auto& states = filter.states();
  if (!states.empty() && std::find(states.begin(), states.end(), solve.state()) == states.end()) return false;
  if (filter.has_termination() && solve.outcome().termination() != filter.termination()) return false;
  if (filter.has_verdict() && solve.outcome().verdict() != filter.verdict()) return false;
  if (!filter.model().empty() && solve.spec().model().name() != filter.model()) return false;
  using google::protobuf::util::TimeUtil;
  const int64_t created_ns = TimeUtil::TimestampToNanoseconds(solve.create_time());
  if (filter.has_create_time_from() && created_ns < TimeUtil::TimestampToNanoseconds(filter.create_time_from())) {
    return false;
  }
  if (filter.has_create_time_before() && created_ns >= TimeUtil::TimestampToNanoseconds(filter.create_time_before())) {
    return false;
  }
  return std::all_of(filter.labels().begin(), filter.labels().end(), [&solve](const auto& label) {
    const auto own = solve.labels().find(label.first);
    return own != solve.labels().end() && own->second == label.second;
  });
}

}  // namespace rollgait::client
