#include "server/access_main.h"

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "server/access/access_store.h"
#include "server/base/clock.h"
#include "server/command_error.h"
#include "server/store/fair_order.h"
#include "server/store/open_store.h"

namespace rollgait::server {
namespace {

constexpr int64_t kDay = 86'400;
constexpr int64_t kTenantStorageMiB = 10'240;  // 6000 results of 1.5 MB with their events
constexpr int64_t kMostStorageMiB = int64_t{1} << 30;

struct Arguments {
  std::string data_dir, store;
  NewToken token;
  std::string scopes = "read,solve";
  std::string expires = "365d";
  std::string id, tenant;
  TenantOverrides limits;
  std::optional<int64_t> max_storage_mb;
  bool defaults = false;
  int rows = 50;
};

std::string Time(int64_t us) {
  if (us == 0) return "never";
  const std::time_t seconds = us / 1'000'000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// "30d", "12h", "15m", "90s" or "never" in seconds; -1: none of these.
int64_t Lifetime(const std::string& text) {
  if (text == "never") return 0;
  const std::map<char, int64_t> units = {{'s', 1}, {'m', 60}, {'h', 3600}, {'d', kDay}};
  if (text.size() < 2 || text.size() > 7 || units.count(text.back()) == 0) return -1;
  const std::string digits = text.substr(0, text.size() - 1);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return -1;
  const int64_t seconds = std::stoll(digits) * units.at(text.back());
  return seconds >= 1 && seconds <= 36'500 * kDay ? seconds : -1;
}

int CreateToken(AccessStore& store, const Arguments& arguments) {
  NewToken token = arguments.token;
  token.scopes = ParseScopes(arguments.scopes).value_or(0);
  token.lifetime_s = Lifetime(arguments.expires);
  const Outcome<Token> made = store.CreateToken(token);
  if (!made.ok()) return ReportError(made.error());
  std::fprintf(stderr, "token %s of tenant %s; this is the only time that it is shown:\n", made.value().id.c_str(),
               token.tenant.c_str());
  std::printf("%s\n", made.value().Text().c_str());
  return 0;
}

int ListTokens(AccessStore& store, const Arguments&) {
  const Outcome<std::vector<TokenRecord>> tokens = store.ListTokens();
  if (!tokens.ok()) return ReportError(tokens.error());
  std::printf("%-16s  %-20s  %-16s  %-20s  %-20s  %-20s  %s\n", "id", "tenant", "scopes", "created", "expires",
              "revoked", "note");
  for (const TokenRecord& token : tokens.value()) {
    std::printf("%-16s  %-20s  %-16s  %-20s  %-20s  %-20s  %s\n", token.id.c_str(), token.tenant.c_str(),
                ScopeNames(token.scopes).c_str(), Time(token.create_time_us).c_str(),
                Time(token.expire_time_us).c_str(), Time(token.revoke_time_us).c_str(), token.note.c_str());
  }
  return 0;
}

int RevokeToken(AccessStore& store, const Arguments& arguments) {
  const Outcome<TokenRecord> token = store.RevokeToken(arguments.id);
  if (!token.ok()) return ReportError(token.error());
  std::printf("%s revoked at %s\n", token.value().id.c_str(), Time(token.value().revoke_time_us).c_str());
  return 0;
}

int SetTenant(AccessStore& store, const Arguments& arguments) {
  TenantOverrides limits = arguments.limits;
  if (arguments.max_storage_mb) limits.max_storage_bytes = *arguments.max_storage_mb << 20;
  if (arguments.defaults) {
    limits.max_queued = limits.max_queued.value_or(-1);
    limits.max_running = limits.max_running.value_or(-1);
    limits.max_watches = limits.max_watches.value_or(-1);
    limits.creates_per_s = limits.creates_per_s.value_or(-1);
    limits.max_simulations = limits.max_simulations.value_or(-1);
    limits.max_storage_bytes = limits.max_storage_bytes.value_or(-1);
    limits.weight = limits.weight.value_or(-1);
  }
  const Outcome<Done> set = store.SetTenant(arguments.tenant, limits);
  return set.ok() ? 0 : ReportError(set.error());
}

std::string Text(const std::optional<int>& limit) { return limit ? std::to_string(*limit) : "default"; }
std::string TextMiB(const std::optional<int64_t>& bytes) { return bytes ? std::to_string(*bytes >> 20) : "default"; }

int ListTenants(AccessStore& store, const Arguments&) {
  const Outcome<std::vector<std::string>> names = store.ListTenants();
  if (!names.ok()) return ReportError(names.error());
  std::printf("%-20s  %10s  %11s  %11s  %13s  %15s  %14s  %7s\n", "tenant", "max queued", "max running", "max watches",
              "creates per s", "max simulations", "max storage MB", "weight");
  for (const std::string& name : names.value()) {
    const Outcome<TenantOverrides> limits = store.FindTenant(name);
    if (!limits.ok()) return ReportError(limits.error());
    const TenantOverrides& of = limits.value();
    char rate[32] = "default";
    if (of.creates_per_s) std::snprintf(rate, sizeof(rate), "%g", *of.creates_per_s);
    std::printf("%-20s  %10s  %11s  %11s  %13s  %15s  %14s  %7s\n", name.c_str(), Text(of.max_queued).c_str(),
                Text(of.max_running).c_str(), Text(of.max_watches).c_str(), rate, Text(of.max_simulations).c_str(),
                TextMiB(of.max_storage_bytes).c_str(), Text(of.weight).c_str());
  }
  return 0;
}

int ShowAudit(AccessStore& store, const Arguments& arguments) {
  const Outcome<std::vector<AuditRow>> rows = store.LastAudit(arguments.rows);
  if (!rows.ok()) return ReportError(rows.error());
  for (auto row = rows.value().rbegin(); row != rows.value().rend(); ++row) {
    std::printf("%s  tenant=%s token=%s peer=%s  %s %s  %s  %s\n", Time(row->time_us).c_str(),
                row->actor.tenant.c_str(), row->actor.token_id.c_str(), row->actor.peer.c_str(), row->action.c_str(),
                row->solve.c_str(), row->outcome.c_str(), row->detail.c_str());
  }
  return 0;
}

using Action = std::function<int(AccessStore&, const Arguments&)>;

CLI::App* AddCommand(CLI::App& parent, const char* name, const char* help, Arguments& arguments, Action& chosen,
                     const Action& action) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->add_option("--data-dir", arguments.data_dir, "Directory of the store, as of rollgaitd");
  command->add_option("--store", arguments.store, "URL of the store, postgresql://..., as of rollgaitd")
      ->envname(kStoreVariable);
  command->callback([&chosen, action] { chosen = action; });
  return command;
}

void AddTokenCommands(CLI::App& app, Arguments& arguments, Action& chosen) {
  CLI::App* const token = app.add_subcommand("token", "Bearer tokens")->require_subcommand(1);
  CLI::App* const create =
      AddCommand(*token, "create", "Make a token and print it, once", arguments, chosen, CreateToken);
  create->add_option("--tenant", arguments.token.tenant, "Whose solves it sees and makes")->required();
  create->add_option("--scopes", arguments.scopes, "Of read, solve, admin, with commas between")
      ->check([](const std::string& text) {
        return ParseScopes(text) ? "" : "must be of read, solve, admin, with commas between";
      })
      ->capture_default_str();
  create->add_option("--expires", arguments.expires, "30d, 12h, 15m, 90s or never")
      ->check([](const std::string& text) {
        return Lifetime(text) >= 0 ? "" : "must be a number followed by d, h, m or s, at most 36500d, or never";
      })
      ->capture_default_str();
  create->add_option("--note", arguments.token.note, "For lists")->check([](const std::string& text) {
    return text.size() <= 200 ? "" : "must have at most 200 characters";
  });
  AddCommand(*token, "list", "Tokens, newest first, without their secrets", arguments, chosen, ListTokens);
  AddCommand(*token, "revoke", "Refuse a token from now on; its streams end within seconds", arguments, chosen,
             RevokeToken)
      ->add_option("ID", arguments.id, "As listed: not the token itself")
      ->required();
}

void AddTenantCommands(CLI::App& app, Arguments& arguments, Action& chosen) {
  CLI::App* const tenant = app.add_subcommand("tenant", "Limits of tenants")->require_subcommand(1);
  CLI::App* const set = AddCommand(*tenant, "set", "Give a tenant limits of its own", arguments, chosen, SetTenant);
  set->add_option("TENANT", arguments.tenant)->required();
  set->add_option("--max-queued", arguments.limits.max_queued, "Solves that may wait")->check(CLI::Range(1, 1'000'000));
  set->add_option("--max-running", arguments.limits.max_running, "Solves that run at once, over all agents")
      ->check(CLI::Range(1, 1'000'000));
  set->add_option("--max-watches", arguments.limits.max_watches, "Open streams, of one server")
      ->check(CLI::Range(1, 1'000'000));
  set->add_option("--creates-per-s", arguments.limits.creates_per_s, "Solves and simulations asked for, of one server")
      ->check(CLI::Range(0.001, 1e6));
  set->add_option("--max-simulations", arguments.limits.max_simulations, "Simulations that run at once, of one server")
      ->check(CLI::Range(1, 1024));
  set->add_option("--max-storage-mb", arguments.max_storage_mb, "MiB that its solves may take in the store")
      ->check(CLI::Range(int64_t{1}, kMostStorageMiB));
  set->add_option("--weight", arguments.limits.weight,
                  "Its share of the solvers beside the other tenants whose solves wait; default: 1")
      ->check(CLI::Range(1, kMostWeight));
  set->add_flag("--defaults", arguments.defaults, "All other limits become the server's again");
  AddCommand(*tenant, "list", "Tenants that have tokens or limits", arguments, chosen, ListTenants);
}

void AddAnswerFlags(CLI::App& app, AnswerLimits& limits) {
  const auto add = [&](const char* name, int64_t& bytes, const char* whose) {
    app.add_option_function<int64_t>(
           name, [&bytes](int64_t mib) { bytes = mib << 20; },
           std::string("MiB of answers that were not read yet, ") + whose + "; more calls are refused")
        ->check(CLI::Range(1, 1 << 20))
        ->default_str(std::to_string(bytes >> 20));
  };
  add("--connection-answers-mb", limits.connection, "of one connection");
  add("--tenant-answers-mb", limits.tenant, "of one tenant");
  add("--answers-mb", limits.all, "of all clients");
}

}  // namespace

void AddAccessFlags(CLI::App& app, AccessFlags& flags) {
  auto* cert =
      app.add_option("--tls-cert", flags.tls.cert, "Certificate chain of this server, PEM; read again when it changes");
  auto* key = app.add_option("--tls-key", flags.tls.key, "Private key of --tls-cert, PEM")->needs(cert);
  cert->needs(key);
  app.add_option("--tls-client-ca", flags.tls.client_ca,
                 "Every client must show a certificate signed by one of these, PEM")
      ->needs(cert);
  app.add_option("--certificate-tenant", flags.certificate_tenant,
                 "A client's certificate stands for the tenant in its cn (common name) or uri (alternative name); "
                 "default: none")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, CertificateTenant>{{"none", CertificateTenant::kNone},
                                                                           {"cn", CertificateTenant::kCommonName},
                                                                           {"uri", CertificateTenant::kUri}}));
  app.add_flag("--require-token", flags.require_token, "Ask every call for a token; see `rollgaitd token --help`");
  app.add_option("--tenant-max-queued", flags.tenant_max_queued,
                 "Solves of a tenant that may wait; 0: no limit of its own; default: half of --max-queued where it is "
                 "asked who calls")
      ->check(CLI::Range(0, 1'000'000));
  app.add_option("--tenant-max-simulations", flags.tenant_max_simulations,
                 "Simulations of a tenant that may run at once; 0: no limit of its own; default: half of "
                 "--simulation-slots where it is asked who calls")
      ->check(CLI::Range(0, 1024));
  app.add_option("--tenant-storage-mb", flags.tenant_storage_mb,
                 "MiB that the solves of a tenant may take in the store; 0: no limit; default: 10240 where it is asked "
                 "who calls")
      ->check(CLI::Range(int64_t{0}, kMostStorageMiB));
  app.add_option("--tenant-max-watches", flags.limits.max_watches, "Streams of a tenant that may be open; 0: no limit")
      ->check(CLI::Range(0, 1'000'000));
  app.add_option("--tenant-creates-per-s", flags.limits.creates_per_s,
                 "Solves and simulations a tenant may ask for; 0: no limit")
      ->check(CLI::Range(0.0, 1e6));
  AddAnswerFlags(app, flags.answers);
  app.add_option("--max-connections", flags.connections.total,
                 "Connections at once; default: what the limit of open files leaves")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-connections-per-peer", flags.connections.per_peer, "Of them from one address; default: half")
      ->check(CLI::Range(1, 1'000'000));
}

TenantLimits AccessFlags::TenantDefaults(int max_queued, int simulations) const {
  const bool share = asks_who_calls();
  TenantLimits all = limits;
  all.max_queued = tenant_max_queued.value_or(share ? (max_queued + 1) / 2 : 0);
  all.max_simulations = tenant_max_simulations.value_or(share ? (simulations + 1) / 2 : 0);
  all.max_storage_bytes = tenant_storage_mb.value_or(share ? kTenantStorageMiB : 0) << 20;
  return all;
}

std::optional<int> RunAccessCommand(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first != "token" && first != "tenant" && first != "audit") return std::nullopt;
  Arguments arguments;
  Action chosen;
  CLI::App app("Who may use a rollgaitd; docs/explanation/security.md", "rollgaitd");
  app.require_subcommand(1);
  AddTokenCommands(app, arguments, chosen);
  AddTenantCommands(app, arguments, chosen);
  AddCommand(app, "audit", "What was changed and who was refused, oldest first", arguments, chosen, ShowAudit)
      ->add_option("--rows", arguments.rows, "At most so many, the newest")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  umask(0077);
  if (arguments.data_dir.empty() && arguments.store.empty()) {
    std::fprintf(stderr, "rollgaitd: say which store: --data-dir DIR or --store postgresql://...\n");
    return 2;
  }
  std::error_code failure;
  if (arguments.store.empty()) std::filesystem::create_directories(arguments.data_dir, failure);
  const SystemClock clock;
  const Outcome<StoreLocation> location = LocateStore(arguments.store, arguments.data_dir);
  if (!location.ok()) return ReportError(location.error());
  const auto store = OpenStore(location.value(), clock);
  if (!store.ok()) return ReportError(store.error());
  AccessStore access(store.value()->database(), clock);
  return chosen(access, arguments);
}

}  // namespace rollgait::server
