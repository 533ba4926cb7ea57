#include "server/storage_main.h"

#include <CLI/CLI.hpp>
#include <chrono>

namespace rollgait::server {

void AddStorageFlags(CLI::App& app, StorageFlags& flags) {
  const auto add = [&](const char* name, auto& value, const char* text) {
    app.add_option(name, value, text)->check(CLI::Range(0.0, 1e9))->capture_default_str();
  };
  add("--keep-solves-days", flags.keep_solves_days, "Days after its end that a solve is deleted; 0: never");
  add("--keep-solves-mb", flags.keep_solves_mb,
      "MiB of finished solves of one tenant above which its oldest are deleted; 0: no limit");
  add("--keep-events-days", flags.keep_events_days,
      "Days after the end of a solve that its event log is reduced to the terminal event; 0: never");
  add("--keep-audit-days", flags.keep_audit_days, "Days that audit rows are kept; 0: for ever");
  add("--reserve-mb", flags.reserve_mb, "MiB of the SQLite file's disk kept for solves that were accepted");
}

RetentionLimits StorageFlags::Retention() const {
  const auto days = [](double count) { return std::chrono::seconds(static_cast<int64_t>(86400 * count)); };
  RetentionLimits limits;
  limits.solves = days(keep_solves_days);
  limits.events = days(keep_events_days);
  limits.audit = days(keep_audit_days);
  limits.solve_bytes = keep_solves_mb << 20;
  return limits;
}

}  // namespace rollgait::server
