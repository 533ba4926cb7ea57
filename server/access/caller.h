#ifndef ROLLGAIT_SERVER_ACCESS_CALLER_H_
#define ROLLGAIT_SERVER_ACCESS_CALLER_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/store/solve_record.h"

namespace rollgait::server {

// What a token allows; sets of them are sums.
enum Scope : unsigned {
  kScopeRead = 1,   // look at what there is
  kScopeSolve = 2,  // make work, cancel, delete
  kScopeAdmin =
      4,  // see, cancel, re-prioritise and delete the solves of every tenant; see the load of the whole server
  kAllScopes = 7,
};

// "read,solve"; the names of rollgait.v1.Caller.scopes.
std::string ScopeNames(unsigned scopes);
// nullopt: the text is not a list of scopes.
std::optional<unsigned> ParseScopes(const std::string& names);

// What one tenant may have at once; 0: no limit but the server's.
struct TenantLimits {
  int max_queued = 0, max_running = 0, max_watches = 0;
  double creates_per_s = 0;
  int max_simulations = 0;
  int64_t max_storage_bytes = 0;  // what its solves and models take in the store
};

// The numbers of rollgait.v1.Caller.Authentication.
enum class Authentication { kOff = 1, kToken = 2, kCertificate = 3 };

// Whom a call comes from. The default is anyone on a server that does not ask.
struct Caller {
  Authentication authentication = Authentication::kOff;
  std::string tenant;       // empty: authentication is off
  std::string identity;     // id of the token, or the name in the certificate
  std::string peer;         // address
  std::string traceparent;  // W3C; goes with the solve
  unsigned scopes = kAllScopes;
  TenantLimits limits = {};

  // Whose solves the caller's own are; nullopt: everyone's.
  std::optional<std::string> sees() const {
    return authentication == Authentication::kOff ? std::nullopt : std::optional(tenant);
  }
  bool administers() const { return (scopes & kScopeAdmin) != 0; }
  // Whether the caller may see and change a solve of this tenant.
  bool reaches(const std::string& other) const { return administers() || sees().value_or(other) == other; }
  Actor actor() const { return {tenant, identity, peer}; }
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_CALLER_H_
