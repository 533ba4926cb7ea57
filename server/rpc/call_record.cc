#include "server/rpc/call_record.h"

#include <unordered_map>
#include <utility>

namespace rollgait::server {
namespace {

struct LivingCalls {
  std::mutex mutex;
  std::unordered_map<const grpc::ServerContextBase*, std::shared_ptr<CallRecord>> records;
};

LivingCalls& Living() {
  static LivingCalls* const living = new LivingCalls;  // calls may end while the process does
  return *living;
}

}  // namespace

void CallRecord::SetCaller(const std::string& tenant, const std::string& token_id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  tenant_ = tenant;
  token_id_ = token_id;
}

void CallRecord::SetSolve(const std::string& id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  solve_ = id;
}

LogFields CallRecord::Fields() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {{"method", origin_.method},           {"solve", solve_},   {"request_id", origin_.request_id},
          {"traceparent", origin_.traceparent}, {"tenant", tenant_}, {"token", token_id_}};
}

std::shared_ptr<CallRecord> RecordOf(const grpc::ServerContextBase& context) {
  const std::lock_guard<std::mutex> lock(Living().mutex);
  const auto found = Living().records.find(&context);
  return found == Living().records.end() ? nullptr : found->second;
}

LogFields FieldsOf(const grpc::ServerContextBase& context) {
  const std::shared_ptr<CallRecord> record = RecordOf(context);
  return record == nullptr ? LogFields() : record->Fields();
}

void KeepRecord(const grpc::ServerContextBase& context, std::shared_ptr<CallRecord> record) {
  const std::lock_guard<std::mutex> lock(Living().mutex);
  Living().records[&context] = std::move(record);
}

void ForgetRecord(const grpc::ServerContextBase& context) {
  const std::lock_guard<std::mutex> lock(Living().mutex);
  Living().records.erase(&context);
}

}  // namespace rollgait::server
