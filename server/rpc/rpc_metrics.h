#ifndef ROLLGAIT_SERVER_RPC_RPC_METRICS_H_
#define ROLLGAIT_SERVER_RPC_RPC_METRICS_H_

#include <grpcpp/support/status.h>

#include <map>
#include <string>

#include "server/base/metrics.h"

namespace rollgait::server {

// The counters of one method, under the names of the gRPC interceptors of other languages (go-grpc-middleware).
struct MethodMetrics {
  std::string service, method, type;  // labels; "unknown" for what is none of ours
  prometheus::Counter* started = nullptr;
  prometheus::Counter* messages_received = nullptr;
  prometheus::Counter* messages_sent = nullptr;
  prometheus::Histogram* seconds = nullptr;
};

// grpc_server_started_total, grpc_server_handled_total (by grpc_code too), grpc_server_handling_seconds,
// grpc_server_msg_received_total, grpc_server_msg_sent_total. The labels of a call come from a table of known methods,
// so that nobody can make series by inventing names. Threads may share it.
class RpcMetrics {
 public:
  explicit RpcMetrics(Metrics& metrics);

  // `path`: "/package.Service/Method".
  MethodMetrics& Of(const std::string& path);
  prometheus::Counter& Handled(const MethodMetrics& method, grpc::StatusCode code);

 private:
  prometheus::Family<prometheus::Counter>& handled_;
  std::map<std::string, MethodMetrics> methods_;  // by path; "" for all others
};

// "OK", "InvalidArgument", "Canceled": the names of Go, which dashboards expect.
std::string CodeName(grpc::StatusCode code);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_RPC_METRICS_H_
