#include "server/store/open_store.h"

#include <filesystem>
#include <utility>

#include "server/base/data_dir.h"
#include "server/base/logging.h"
#include "server/base/notify.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_hints.h"
#include "server/store/sqlite_connection.h"

namespace rollgait::server {

Outcome<std::unique_ptr<SqlStore>> OpenStore(const StoreLocation& location, const Clock& clock) {
  Database::Options options;
  options.name = location.Name();
  options.readers = location.connections;
  if (location.is_postgres()) {
    options.writers = location.connections;
    options.connect = [url = location.postgres_url] { return std::make_unique<PostgresConnection>(url); };
  } else {
    options.group_writes = true;
    options.connect = [path = location.sqlite_path, &clock] { return std::make_unique<SqliteConnection>(path, clock); };
  }
  return SqlStore::Open(std::make_unique<Database>(std::move(options)), clock, RoomOf(location));
}

DiskRoom RoomOf(const StoreLocation& location) {
  if (location.is_postgres()) return {};
  const std::string folder = std::filesystem::path(location.sqlite_path).parent_path().string();
  return {folder.empty() ? "." : folder, location.reserve_bytes};
}

Outcome<std::unique_ptr<SqlStore>> AwaitStore(const StoreLocation& location, const Clock& clock,
                                              std::chrono::seconds wait,
                                              const std::function<bool(std::chrono::milliseconds)>& sleep) {
  const auto give_up = std::chrono::steady_clock::now() + wait;
  while (true) {
    Outcome<std::unique_ptr<SqlStore>> store = OpenStore(location, clock);
    const bool may_help = !store.ok() && store.error().code == ErrorCode::kUnavailable && location.is_postgres();
    if (!may_help || std::chrono::steady_clock::now() >= give_up) return store;
    LogEvent(spdlog::level::warn, "store.awaited", {{"reason", store.error().message}});
    if (!sleep(std::chrono::seconds(1))) return store;
  }
}

Outcome<std::unique_ptr<HintChannel>> OpenHints(const StoreLocation& location, const std::string& data_dir,
                                                HintRole role) {
  const bool is_server = role == HintRole::kServer;
  if (!location.is_postgres()) {
    return SocketHints::Create(data_dir, is_server ? kServerSocket : kAgentSocket,
                               is_server ? kAgentSocket : kServerSocket);
  }
  const std::string servers = "rollgait_servers", agents = "rollgait_agents";
  return std::unique_ptr<HintChannel>(
      std::make_unique<PostgresHints>(location.postgres_url, is_server ? servers : agents,
                                      is_server ? std::vector{agents, servers} : std::vector{servers}));
}

}  // namespace rollgait::server
