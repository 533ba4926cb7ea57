#include "server/rpc/rpc_metrics.h"

#include <google/protobuf/descriptor.h>

#include <array>
#include <cstddef>

#include "core/base/check.h"
#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::server {
namespace {

const prometheus::Histogram::BucketBoundaries kSeconds = {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25,
                                                          0.5,   1,      2.5,   5,    10,    30,   60,  300};

// Methods that gRPC itself serves.
struct OtherMethod {
  const char *service, *method, *type;
};
constexpr OtherMethod kOtherMethods[] = {
    {"grpc.health.v1.Health", "Check", "unary"},
    {"grpc.health.v1.Health", "Watch", "server_stream"},
    {"grpc.reflection.v1alpha.ServerReflection", "ServerReflectionInfo", "bidi_stream"},
};

std::string TypeOf(const google::protobuf::MethodDescriptor& method) {
  if (method.client_streaming()) return method.server_streaming() ? "bidi_stream" : "client_stream";
  return method.server_streaming() ? "server_stream" : "unary";
}

}  // namespace

RpcMetrics::RpcMetrics(Metrics& metrics)
    : handled_(CounterFamily(metrics, "grpc_server_handled_total", "Calls that ended, by status code")) {
  auto& started = CounterFamily(metrics, "grpc_server_started_total", "Calls that began");
  auto& received = CounterFamily(metrics, "grpc_server_msg_received_total", "Messages read from clients");
  auto& sent = CounterFamily(metrics, "grpc_server_msg_sent_total", "Messages written to clients");
  auto& seconds =
      HistogramFamily(metrics, "grpc_server_handling_seconds", "From the beginning of a call to its status, in s");
  const auto add = [&](const std::string& path, const std::string& service, const std::string& method,
                       const std::string& type) {
    const prometheus::Labels labels = {{"grpc_service", service}, {"grpc_method", method}, {"grpc_type", type}};
    const MethodMetrics& added = methods_
                                     .insert({path,
                                              {service, method, type, &started.Add(labels), &received.Add(labels),
                                               &sent.Add(labels), &seconds.Add(labels, kSeconds)}})
                                     .first->second;
    // Series that exist from the beginning show their first increase.
    Handled(added, grpc::StatusCode::OK);
  };
  const google::protobuf::ServiceDescriptor* const service =
      v1::ServerInfo::descriptor()->file()->FindServiceByName("GaitService");
  ROLLGAIT_CHECK(service != nullptr);
  for (int i = 0; i < service->method_count(); ++i) {
    const google::protobuf::MethodDescriptor& method = *service->method(i);
    add("/" + service->full_name() + "/" + method.name(), service->full_name(), method.name(), TypeOf(method));
  }
  for (const OtherMethod& other : kOtherMethods) {
    add(std::string("/") + other.service + "/" + other.method, other.service, other.method, other.type);
  }
  add("", "unknown", "unknown", "unknown");
}

MethodMetrics& RpcMetrics::Of(const std::string& path) {
  const auto found = methods_.find(path);
  return found == methods_.end() ? methods_.at("") : found->second;
}

prometheus::Counter& RpcMetrics::Handled(const MethodMetrics& method, grpc::StatusCode code) {
  return handled_.Add({{"grpc_service", method.service},
                       {"grpc_method", method.method},
                       {"grpc_type", method.type},
                       {"grpc_code", CodeName(code)}});
}

std::string CodeName(grpc::StatusCode code) {
  constexpr std::array<const char*, 17> kNames = {
      "OK",       "Canceled",       "Unknown",          "InvalidArgument",   "DeadlineExceeded",
      "NotFound", "AlreadyExists",  "PermissionDenied", "ResourceExhausted", "FailedPrecondition",
      "Aborted",  "OutOfRange",     "Unimplemented",    "Internal",          "Unavailable",
      "DataLoss", "Unauthenticated"};
  const auto index = static_cast<size_t>(code);
  return index < kNames.size() ? kNames[index] : "Unknown";
}

}  // namespace rollgait::server
