#ifndef ROLLGAIT_SERVER_RPC_CALL_RECORD_H_
#define ROLLGAIT_SERVER_RPC_CALL_RECORD_H_

#include <grpcpp/grpcpp.h>

#include <memory>
#include <mutex>
#include <string>

#include "server/base/logging.h"

namespace rollgait::server {

// What is known of a call while it lives. Threads may share it.
class CallRecord {
 public:
  struct Origin {
    std::string method;       // "/rollgait.v1.GaitService/GetSolve"; "unknown" if it is none of ours
    std::string request_id;   // of the client (x-request-id), or made here
    std::string traceparent;  // W3C: our part of the client's trace, or of one made here
    std::string peer;
  };
  explicit CallRecord(Origin origin) : origin_(std::move(origin)) {}

  const Origin& origin() const { return origin_; }
  // Who calls, once that is known, and which solve it is about. For the log.
  void SetCaller(const std::string& tenant, const std::string& token_id);
  void SetSolve(const std::string& id);
  // method, request_id, traceparent, and tenant, token, solve where they are known: for a LogScope around the call's
  // work.
  LogFields Fields() const;

 private:
  const Origin origin_;
  mutable std::mutex mutex_;  // protects what follows
  std::string tenant_, token_id_, solve_;
};

// The record of a living call; null on a server without a CallObserver.
std::shared_ptr<CallRecord> RecordOf(const grpc::ServerContextBase& context);
// Its fields; none without a record.
LogFields FieldsOf(const grpc::ServerContextBase& context);

// For the observer: makes a record findable, and forgets it.
void KeepRecord(const grpc::ServerContextBase& context, std::shared_ptr<CallRecord> record);
void ForgetRecord(const grpc::ServerContextBase& context);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_CALL_RECORD_H_
