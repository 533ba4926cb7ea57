#include "server/service/filter_check.h"

#include <algorithm>

#include "server/service/label_check.h"

namespace rollgait::server {
namespace {

constexpr size_t kLongestModel = 128;

// µs since 1970, rounded up: a time that the store counts in µs is at or after one exactly if it is at or after the
// other. A violation for a time that is none of google.protobuf.Timestamp.
int64_t Micros(const google::protobuf::Timestamp& time, const std::string& field, Violations* violations) {
  constexpr int64_t kYear1 = -62'135'596'800, kYear10000 = 253'402'300'800;
  if (time.seconds() < kYear1 || time.seconds() >= kYear10000 || time.nanos() < 0 || time.nanos() >= 1'000'000'000) {
    violations->push_back({field, "has " + std::to_string(time.seconds()) + " seconds and " +
                                      std::to_string(time.nanos()) +
                                      " nanos, must lie in the years 1 to 9999 with nanos from 0 to 999999999"});
    return 0;
  }
  return time.seconds() * 1'000'000 + (time.nanos() + 999) / 1000;
}

void ReadStates(const v1::SolveFilter& filter, SolveFilter* read, Violations* violations) {
  for (int i = 0; i < filter.states_size(); ++i) {
    const auto state = static_cast<SolveState>(filter.states(i));
    const std::string field = "filter.states[" + std::to_string(i) + "]";
    if (filter.states(i) == v1::SOLVE_STATE_UNSPECIFIED) {
      violations->push_back({field, "is SOLVE_STATE_UNSPECIFIED; leave it out, or leave all states out for any"});
    } else if (std::find(read->states.begin(), read->states.end(), state) != read->states.end()) {
      violations->push_back({field, "is " + v1::SolveState_Name(filter.states(i)) + " again; name each state once"});
      return;  // a list of any length has six different states at most
    } else {
      read->states.push_back(state);
    }
  }
}

}  // namespace

void ReadFilter(const v1::ListSolvesRequest& request, ListQuery* query, Violations* violations) {
  if (request.tenant().find('\0') != std::string::npos) {
    violations->push_back({"tenant", "holds a NUL, which no tenant's name has"});
  }
  if (request.state() != v1::SOLVE_STATE_UNSPECIFIED) query->state = static_cast<SolveState>(request.state());
  const v1::SolveFilter& filter = request.filter();
  SolveFilter& read = query->filter;
  ReadStates(filter, &read, violations);
  if (query->state.has_value() && filter.states_size() > 0) {
    violations->push_back({"state", "is set besides filter.states; name all states in filter.states"});
  }
  if (read.states.size() == 1) {  // there is an index for one
    query->state = read.states[0];
    read.states.clear();
  }
  if (filter.has_termination()) read.termination = filter.termination();
  if (filter.has_verdict()) read.verdict = filter.verdict();
  read.labels = ReadLabels(filter.labels(), kMostFilterLabels, "filter.", violations);
  read.model = filter.model();
  if (read.model.size() > kLongestModel) {
    violations->push_back({"filter.model", "is " + std::to_string(read.model.size()) + " bytes long, the limit is " +
                                               std::to_string(kLongestModel)});
  } else if (read.model.find('\0') != std::string::npos) {
    violations->push_back({"filter.model", "holds a NUL, which no model's name has"});
  }
  if (filter.has_create_time_from()) {
    read.created_from_us = Micros(filter.create_time_from(), "filter.create_time_from", violations);
  }
  if (filter.has_create_time_before()) {
    read.created_before_us = Micros(filter.create_time_before(), "filter.create_time_before", violations);
  }
  if (violations->empty() && read.created_before_us <= read.created_from_us) {
    violations->push_back({"filter.create_time_before", "is not after filter.create_time_from; nothing lies between"});
  }
}

}  // namespace rollgait::server
