#include "client/sweep/batches.h"

#include <optional>
#include <string>
#include <utility>

#include "client/failure.h"

namespace rollgait::client {
namespace {

// Words of the server's refusal.
constexpr char kTooLong[] = "send it in several batches";

class Batches {
 public:
  Batches(Connection& connection, const std::function<void(double seconds)>& wait)
      : connection_(connection), wait_(wait) {}

  void Create(const v1::BatchCreateSolvesRequest& request) {
    v1::BatchCreateSolvesResponse response;
    const grpc::Status status = Call(request, &response);
    const int count = request.requests_size();
    if (count > 1 && status.error_code() == grpc::StatusCode::INVALID_ARGUMENT &&
        status.error_message().find(kTooLong) != std::string::npos) {
      for (const auto& [first, end] : {std::pair(0, count / 2), std::pair(count / 2, count)}) {
        v1::BatchCreateSolvesRequest half;
        for (int i = first; i < end; ++i) *half.add_requests() = request.requests(i);
        Create(half);
      }
      return;
    }
    RequireOk(status, "create the solves", connection_.server());
    if (response.solves_size() != count) {
      throw Failure(ExitCode::kInternal, "the server answered " + std::to_string(response.solves_size()) +
                                             " solves to " + std::to_string(count) + " requests");
    }
    for (v1::Solve& solve : *response.mutable_solves()) solves_.push_back(std::move(solve));
  }
  std::vector<v1::Solve> Take() { return std::move(solves_); }

 private:
  // Once more after each of the two that can pass, which the request_ids make safe.
  grpc::Status Call(const v1::BatchCreateSolvesRequest& request, v1::BatchCreateSolvesResponse* response) {
    bool repeated = false, waited = false;
    while (true) {
      grpc::ClientContext context;
      connection_.SetDeadline(context);
      grpc::Status status = connection_.stub().BatchCreateSolves(&context, request, response);
      const std::optional<double> delay_s = RetryDelay(status);
      if (status.error_code() == grpc::StatusCode::UNAVAILABLE && !repeated) {
        repeated = true;
      } else if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED && delay_s && !waited) {
        waited = true;
        wait_(*delay_s);
      } else {
        return status;
      }
    }
  }

  Connection& connection_;
  const std::function<void(double seconds)>& wait_;
  std::vector<v1::Solve> solves_;
};

}  // namespace

std::vector<v1::Solve> CreateInBatches(Connection& connection, const std::vector<v1::CreateSolveRequest>& requests,
                                       const std::function<void(double seconds)>& wait) {
  Batches batches(connection, wait);
  v1::BatchCreateSolvesRequest batch;
  size_t bytes = 0;
  for (const v1::CreateSolveRequest& request : requests) {
    const bool is_full = batch.requests_size() == static_cast<int>(kMostAtOnce);
    if (is_full || (batch.requests_size() > 0 && bytes + request.ByteSizeLong() > kMostBytesAtOnce)) {
      batches.Create(batch);
      batch.Clear();
      bytes = 0;
    }
    bytes += request.ByteSizeLong();
    *batch.add_requests() = request;
  }
  if (batch.requests_size() > 0) batches.Create(batch);
  return batches.Take();
}

}  // namespace rollgait::client
