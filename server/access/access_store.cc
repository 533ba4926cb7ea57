#include "server/access/access_store.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace rollgait::server {
namespace {

#define ROLLGAIT_TOKEN_COLUMNS "id, hash, tenant, scopes, create_time_us, expire_time_us, revoke_time_us, note "

TokenRecord ReadToken(const Query& query) {
  TokenRecord token;
  token.id = query.Bytes(0);
  token.hash = query.Bytes(1);
  token.tenant = query.Bytes(2);
  token.scopes = ParseScopes(query.Bytes(3)).value_or(0);
  token.create_time_us = query.Int(4);
  token.expire_time_us = query.Int(5);
  token.revoke_time_us = query.Int(6);
  token.note = query.Bytes(7);
  return token;
}

std::optional<TokenRecord> Find(SqlConnection& connection, const std::string& id) {
  Query query(connection, "SELECT " ROLLGAIT_TOKEN_COLUMNS "FROM tokens WHERE id = ?", id);
  if (!query.Step()) return std::nullopt;
  return ReadToken(query);
}

void Append(SqlConnection& connection, const AuditRow& row, int64_t now_us) {
  Query(connection,
        "INSERT INTO audit (time_us, tenant, token_id, peer, action, solve, outcome, detail) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        now_us, row.actor.tenant, row.actor.token_id, row.actor.peer, row.action, row.solve, row.outcome, row.detail)
      .Run();
}

Error BadTenant(const std::string& name) {
  const std::string message =
      "is \"" + name.substr(0, 80) + "\"; must have 1 to 64 of the letters a-z A-Z, digits and . _ - : /";
  return {ErrorCode::kInvalidArgument, "tenant " + message, {{"tenant", message}}};
}

template <typename Number>
std::optional<Number> IfSet(Number value) {
  return value < 0 ? std::nullopt : std::optional<Number>(value);
}

}  // namespace

bool IsTenantName(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return letter < 128 &&
           (std::isalnum(letter) || std::string("._-:/").find(static_cast<char>(letter)) != std::string::npos);
  });
}

Outcome<Token> AccessStore::CreateToken(const NewToken& token) {
  if (!IsTenantName(token.tenant)) return BadTenant(token.tenant);
  const Token made = Token::Random();
  const int64_t now = clock_.WallMicros();
  const int64_t expire = token.lifetime_s > 0 ? now + 1'000'000 * token.lifetime_s : 0;
  return database_.Write([&](SqlConnection& connection) -> Outcome<Token> {
    Query(connection,
          "INSERT INTO tokens (id, hash, tenant, scopes, create_time_us, expire_time_us, revoke_time_us, note) "
          "VALUES (?, ?, ?, ?, ?, ?, 0, ?)",
          made.id, made.Hash(), token.tenant, ScopeNames(token.scopes), now, expire, token.note)
        .Run();
    Append(connection,
           {0, 0, {token.tenant, made.id, "command line"}, "create token", "", "ok", ScopeNames(token.scopes)}, now);
    return made;
  });
}

Outcome<std::vector<TokenRecord>> AccessStore::ListTokens() {
  return database_.Read([](SqlConnection& connection) -> Outcome<std::vector<TokenRecord>> {
    std::vector<TokenRecord> tokens;
    Query query(connection, "SELECT " ROLLGAIT_TOKEN_COLUMNS "FROM tokens ORDER BY create_time_us DESC, id");
    while (query.Step()) tokens.push_back(ReadToken(query));
    return tokens;
  });
}

Outcome<std::optional<TokenRecord>> AccessStore::FindToken(const std::string& id) {
  return database_.ReadOne(
      [&](SqlConnection& connection) -> Outcome<std::optional<TokenRecord>> { return Find(connection, id); });
}

Outcome<TokenRecord> AccessStore::RevokeToken(const std::string& id) {
  return database_.Write([&](SqlConnection& connection) -> Outcome<TokenRecord> {
    std::optional<TokenRecord> token = Find(connection, id);
    if (!token)
      return Error{ErrorCode::kNotFound, "there is no token " + id + "; `rollgaitd token list` lists those that are"};
    if (token->revoke_time_us != 0) return *token;
    token->revoke_time_us = clock_.WallMicros();
    Query(connection, "UPDATE tokens SET revoke_time_us = ? WHERE id = ?", token->revoke_time_us, id).Run();
    Append(connection, {0, 0, {token->tenant, id, "command line"}, "revoke token", "", "ok", ""},
           token->revoke_time_us);
    return *token;
  });
}

Outcome<Done> AccessStore::SetTenant(const std::string& tenant, const TenantOverrides& limits) {
  if (!IsTenantName(tenant)) return BadTenant(tenant);
  return database_.Write([&](SqlConnection& connection) -> Outcome<Done> {
    Query(
        connection,
        "INSERT INTO tenants (tenant, max_queued, max_running, max_watches, creates_per_s) VALUES (?, -1, -1, -1, -1) "
        "ON CONFLICT (tenant) DO NOTHING",
        tenant)
        .Run();
    if (limits.max_queued)
      Query(connection, "UPDATE tenants SET max_queued = ? WHERE tenant = ?", *limits.max_queued, tenant).Run();
    if (limits.max_running)
      Query(connection, "UPDATE tenants SET max_running = ? WHERE tenant = ?", *limits.max_running, tenant).Run();
    if (limits.max_watches)
      Query(connection, "UPDATE tenants SET max_watches = ? WHERE tenant = ?", *limits.max_watches, tenant).Run();
    if (limits.max_simulations) {
      Query(connection, "UPDATE tenants SET max_simulations = ? WHERE tenant = ?", *limits.max_simulations, tenant)
          .Run();
    }
    if (limits.max_storage_bytes) {
      Query(connection, "UPDATE tenants SET max_storage_bytes = ? WHERE tenant = ?", *limits.max_storage_bytes, tenant)
          .Run();
    }
    if (limits.weight) {
      Query(connection, "UPDATE tenants SET weight = ? WHERE tenant = ?", *limits.weight, tenant).Run();
    }
    if (limits.creates_per_s) {
      Query(connection, "UPDATE tenants SET creates_per_s = ? WHERE tenant = ?", *limits.creates_per_s, tenant).Run();
    }
    Append(connection, {0, 0, {tenant, "", "command line"}, "set tenant", "", "ok", ""}, clock_.WallMicros());
    return Done{};
  });
}

Outcome<TenantOverrides> AccessStore::FindTenant(const std::string& tenant) {
  return database_.ReadOne([&](SqlConnection& connection) -> Outcome<TenantOverrides> {
    TenantOverrides found;
    Query query(connection,
                "SELECT max_queued, max_running, max_watches, creates_per_s, max_simulations, max_storage_bytes, "
                "weight FROM tenants WHERE tenant = ?",
                tenant);
    if (!query.Step()) return found;
    found.max_queued = IfSet(static_cast<int>(query.Int(0)));
    found.max_running = IfSet(static_cast<int>(query.Int(1)));
    found.max_watches = IfSet(static_cast<int>(query.Int(2)));
    found.creates_per_s = IfSet(query.Double(3));
    found.max_simulations = IfSet(static_cast<int>(query.Int(4)));
    found.max_storage_bytes = IfSet(query.Int(5));
    found.weight = IfSet(static_cast<int>(query.Int(6)));
    return found;
  });
}

Outcome<std::vector<std::string>> AccessStore::ListTenants() {
  return database_.Read([](SqlConnection& connection) -> Outcome<std::vector<std::string>> {
    std::vector<std::string> names;
    Query query(connection, "SELECT tenant FROM tenants UNION SELECT tenant FROM tokens ORDER BY tenant");
    while (query.Step()) names.push_back(query.Bytes(0));
    return names;
  });
}

Outcome<Done> AccessStore::AddAudit(const AuditRow& row) {
  return database_.Write([&](SqlConnection& connection) -> Outcome<Done> {
    Append(connection, row, clock_.WallMicros());
    return Done{};
  });
}

Outcome<std::vector<AuditRow>> AccessStore::LastAudit(int rows) {
  return database_.Read([&](SqlConnection& connection) -> Outcome<std::vector<AuditRow>> {
    std::vector<AuditRow> last;
    Query query(connection,
                "SELECT number, time_us, tenant, token_id, peer, action, solve, outcome, detail FROM audit "
                "ORDER BY number DESC LIMIT ?",
                rows);
    while (query.Step()) {
      last.push_back({query.Int(0),
                      query.Int(1),
                      {query.Bytes(2), query.Bytes(3), query.Bytes(4)},
                      query.Bytes(5),
                      query.Bytes(6),
                      query.Bytes(7),
                      query.Bytes(8)});
    }
    return last;
  });
}

}  // namespace rollgait::server
