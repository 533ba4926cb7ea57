#ifndef ROLLGAIT_TESTS_E2E_WATCHING_H_
#define ROLLGAIT_TESTS_E2E_WATCHING_H_

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"

namespace rollgait::server {

inline v1::Solve CreateSolve(v1::GaitService::Stub& stub, const v1::SolveSpec& spec) {
  grpc::ClientContext context;
  v1::CreateSolveRequest request;
  *request.mutable_spec() = spec;
  v1::Solve solve;
  const grpc::Status status = stub.CreateSolve(&context, request, &solve);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return solve;
}

// What a client has seen of a solve, over any number of connections.
struct Seen {
  int64_t last = 0;
  bool dense = true;
  int iterations = 0;
  std::vector<std::pair<int, int>> places;             // mesh and index of the iterations
  std::vector<std::pair<v1::SolveState, int>> states;  // with attempt
  v1::Solve finished;
  bool has_finished = false;

  void Add(const v1::SolveEvent& event) {
    if (event.has_heartbeat()) {
      dense = dense && event.sequence() == last;
      return;
    }
    dense = dense && event.sequence() == last + event.skipped_count() + 1;
    last = event.sequence();
    if (event.has_iteration()) {
      iterations += 1 + event.skipped_count();
      places.emplace_back(event.iteration().mesh(), event.iteration().index());
    }
    if (event.has_state_change()) states.emplace_back(event.state_change().state(), event.state_change().attempt());
    if (event.has_finished()) {
      finished = event.finished();
      has_finished = true;
    }
  }
};

// Watches on from what was seen until the stream ends or `enough` holds. Returns how the stream ended.
inline grpc::Status WatchOn(
    v1::GaitService::Stub& stub, const std::string& name, Seen& seen,
    const std::function<bool(const Seen&)>& enough = [](const Seen&) { return false; }) {
  grpc::ClientContext context;
  v1::WatchSolveRequest request;
  request.set_name(name);
  request.set_after_sequence(seen.last);
  const auto stream = stub.WatchSolve(&context, request);
  v1::SolveEvent event;
  while (!enough(seen) && stream->Read(&event)) seen.Add(event);
  if (enough(seen)) context.TryCancel();
  return stream->Finish();
}

// For WatchOn: so many iterations were seen.
inline std::function<bool(const Seen&)> Iterations(int count) {
  return [count](const Seen& seen) { return seen.iterations >= count; };
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_E2E_WATCHING_H_
