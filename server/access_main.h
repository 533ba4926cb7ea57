#ifndef ROLLGAIT_SERVER_ACCESS_MAIN_H_
#define ROLLGAIT_SERVER_ACCESS_MAIN_H_

#include <optional>

#include "server/access/answer_budget.h"
#include "server/access/caller.h"
#include "server/rpc/call_identity.h"
#include "server/rpc/connection_acceptor.h"
#include "server/rpc/tls_files.h"

namespace CLI {
class App;
}

namespace rollgait::server {

// Who may use a server: docs/explanation/security.md.
struct AccessFlags {
  TlsFiles tls;
  CertificateTenant certificate_tenant = CertificateTenant::kNone;
  bool require_token = false;
  AnswerLimits answers;
  TenantLimits limits;  // but for those that follow: TenantDefaults
  // Not given: half of the queue, half of the simulations, kTenantStorage, where it is asked who calls.
  std::optional<int> tenant_max_queued, tenant_max_simulations;
  std::optional<int64_t> tenant_storage_mb;
  ConnectionLimits connections;

  bool asks_who_calls() const { return require_token || certificate_tenant != CertificateTenant::kNone; }
  // The limits of a tenant that has none of its own, on a server that queues at most `max_queued` solves and runs at
  // most `simulations` at once.
  TenantLimits TenantDefaults(int max_queued, int simulations) const;
};
void AddAccessFlags(CLI::App& app, AccessFlags& flags);

// `rollgaitd token|tenant|audit ...`: works on the store, beside a running server or without one. Returns the exit
// code; nullopt if the arguments are not of these commands.
std::optional<int> RunAccessCommand(int argc, char** argv);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_MAIN_H_
