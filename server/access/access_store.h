#ifndef ROLLGAIT_SERVER_ACCESS_ACCESS_STORE_H_
#define ROLLGAIT_SERVER_ACCESS_ACCESS_STORE_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/access/caller.h"
#include "server/access/token.h"
#include "server/base/clock.h"
#include "server/store/database.h"
#include "server/store/solve_record.h"

namespace rollgait::server {

struct NewToken {
  std::string tenant;
  unsigned scopes = 0;
  int64_t lifetime_s = 0;  // 0: never expires
  std::string note;
};

// Limits of one tenant that differ from the server's; nullopt: they do not.
struct TenantOverrides {
  std::optional<int> max_queued, max_running, max_watches;
  std::optional<double> creates_per_s;
  std::optional<int> max_simulations = {};
  std::optional<int64_t> max_storage_bytes = {};
  std::optional<int> weight = {};  // of its turns, [1, kMostWeight] of server/store/fair_order.h
};

// Tokens, tenants and the audit trail, beside the solves in the same database. Any thread and process may call; every
// call may block, and fail with kUnavailable or kInternal.
class AccessStore {
 public:
  // Both outlive it.
  AccessStore(Database& database, const Clock& clock) : database_(database), clock_(clock) {}

  // Stores the hash and returns the token, which cannot be told again. kInvalidArgument: the tenant's name is empty,
  // longer than 64 or has other than letters, digits, '.', '_', '-', ':' and '/'.
  Outcome<Token> CreateToken(const NewToken& token);
  // Newest first.
  Outcome<std::vector<TokenRecord>> ListTokens();
  Outcome<std::optional<TokenRecord>> FindToken(const std::string& id);
  // From now on it is refused. kNotFound; a second time: no effect.
  Outcome<TokenRecord> RevokeToken(const std::string& id);

  // Replaces the limits of a tenant that are given.
  Outcome<Done> SetTenant(const std::string& tenant, const TenantOverrides& limits);
  Outcome<TenantOverrides> FindTenant(const std::string& tenant);
  // Names with limits of their own or a token.
  Outcome<std::vector<std::string>> ListTenants();

  Outcome<Done> AddAudit(const AuditRow& row);
  // Newest first.
  Outcome<std::vector<AuditRow>> LastAudit(int rows);

 private:
  Database& database_;
  const Clock& clock_;
};

// Whether a text may be a tenant's name.
bool IsTenantName(const std::string& name);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_ACCESS_STORE_H_
