#include "server/rpc/call_observer.h"

#include <grpcpp/grpcpp.h>
#include <spdlog/common.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "server/base/digest.h"
#include "server/base/logging.h"
#include "server/base/trace_context.h"
#include "server/rpc/call_record.h"
#include "server/rpc/door.h"

namespace rollgait::server {
namespace {

using grpc::experimental::InterceptionHookPoints;
using Metadata = CallMetadata;

constexpr size_t kMaxRequestId = 128;

std::string Value(const Metadata& metadata, const char* name) {
  const auto found = metadata.find(name);
  return found == metadata.end() ? "" : std::string(found->second.data(), found->second.size());
}

bool IsRequestId(const std::string& text) {
  return !text.empty() && text.size() <= kMaxRequestId &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

bool OnlyReads(const MethodMetrics& method) {
  return method.service != "rollgait.v1.GaitService" || method.method.starts_with("Get") ||
         method.method.starts_with("List");
}

bool IsDefect(grpc::StatusCode code) {
  return code == grpc::StatusCode::INTERNAL || code == grpc::StatusCode::UNKNOWN || code == grpc::StatusCode::DATA_LOSS;
}

}  // namespace

// One call, from its metadata to its end. gRPC calls Intercept from one thread at a time for each direction.
class CallObserver::Call : public grpc::experimental::Interceptor {
 public:
  Call(std::shared_ptr<Shared> shared, grpc::experimental::ServerRpcInfo* info)
      : shared_(std::move(shared)),
        info_(*info),
        context_(*info->server_context()),
        method_(shared_->rpc.Of(info->method())) {
    method_.started->Increment();
  }

  ~Call() override {
    ForgetRecord(context_);
    if (record_ != nullptr && !ended_) End(grpc::Status(grpc::StatusCode::CANCELLED, "the client has gone"));
  }

  void Intercept(grpc::experimental::InterceptorBatchMethods* batch) override {
    const auto at = [&](InterceptionHookPoints point) { return batch->QueryInterceptionHookPoint(point); };
    if (at(InterceptionHookPoints::POST_RECV_INITIAL_METADATA)) Begin(*batch->GetRecvInitialMetadata());
    if (at(InterceptionHookPoints::POST_RECV_MESSAGE) && batch->GetRecvMessage() != nullptr)
      method_.messages_received->Increment();
    if (at(InterceptionHookPoints::PRE_SEND_MESSAGE)) method_.messages_sent->Increment();
    if (at(InterceptionHookPoints::PRE_SEND_INITIAL_METADATA) && at(InterceptionHookPoints::PRE_SEND_STATUS) &&
        shared_->behind_door && batch->GetSendStatus().error_code() == grpc::StatusCode::UNAUTHENTICATED) {
      batch->GetSendInitialMetadata()->emplace(kDoorRefused, "unauthenticated");
    }
    if (at(InterceptionHookPoints::PRE_SEND_STATUS) && IsUnreadable(batch->GetSendStatus())) {
      batch->ModifySendStatus(
          {grpc::StatusCode::INVALID_ARGUMENT, "the bytes are not a request message of " + method_.method +
                                                   "; send what rollgait/v1/gait_service.proto describes"});
    }
    if (at(InterceptionHookPoints::PRE_SEND_STATUS) && !ended_) End(batch->GetSendStatus());
    batch->Proceed();
  }

 private:
  // What gRPC answers, without a word, to a message that cannot be read.
  bool IsUnreadable(const grpc::Status& status) const {
    return method_.service == "rollgait.v1.GaitService" && status.error_code() == grpc::StatusCode::UNIMPLEMENTED &&
           status.error_message().empty();
  }

  void Begin(const Metadata& metadata) {
    const std::string wish = Value(metadata, "x-request-id");
    CallRecord::Origin origin;
    origin.method = method_.service == "unknown" ? "unknown" : info_.method();
    origin.request_id = IsRequestId(wish) ? wish : RandomId();
    origin.traceparent = ContinueTrace(Value(metadata, "traceparent"));
    const Outcome<std::string> told = shared_->behind_door ? PeerBehindDoor(metadata) : context_.peer();
    origin.peer = told.ok() ? told.value() : context_.peer();
    context_.AddInitialMetadata("x-request-id", origin.request_id);
    record_ = std::make_shared<CallRecord>(std::move(origin));
    KeepRecord(context_, record_);
  }

  void End(const grpc::Status& status) {
    ended_ = true;
    const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start_;
    shared_->rpc.Handled(method_, status.error_code()).Increment();
    method_.seconds->Observe(duration.count());
    const bool refused = !status.ok() && !IsDefect(status.error_code());
    const std::optional<int64_t> suppressed = refused ? shared_->refusals.Take() : 0;
    if (record_ == nullptr || !suppressed) return;
    const auto level = IsDefect(status.error_code())    ? spdlog::level::err
                       : refused || !OnlyReads(method_) ? spdlog::level::info
                                                        : spdlog::level::debug;
    const LogFields fields = record_->Fields();
    const LogScope scope(fields);
    const std::string code = CodeName(status.error_code());
    if (status.ok()) {
      LogEvent(level, "call.finished",
               {{"code", code}, {"duration_s", duration.count()}, {"peer", record_->origin().peer}});
    } else {
      LogEvent(level, "call.finished",
               {{"code", code},
                {"duration_s", duration.count()},
                {"peer", record_->origin().peer},
                {"reason", status.error_message()},
                {"suppressed", *suppressed}});
    }
  }

  const std::shared_ptr<Shared> shared_;
  grpc::experimental::ServerRpcInfo& info_;
  grpc::ServerContextBase& context_;
  MethodMetrics& method_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::shared_ptr<CallRecord> record_;
  std::atomic<bool> ended_{false};
};

grpc::experimental::Interceptor* CallObserver::CreateServerInterceptor(grpc::experimental::ServerRpcInfo* info) {
  return new Call(shared_, info);
}

}  // namespace rollgait::server
