#include "server/store/open_store.h"

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>

#include "server/base/data_dir.h"
#include "server/base/logging.h"
#include "server/base/notify.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_hints.h"
#include "server/store/sqlite_connection.h"

namespace rollgait::server {
namespace {

// SQLite's log is written back into the store after 1000 pages, 4 MB. On a full disk that ends half way, and the log
// grows by what is left, which was less. This is twice what both then need to get to their end.
constexpr int64_t kMostDeletionReserve = int64_t{16} << 20;

// An empty file is what is left of a store, or what another process begins to write at this moment.
bool IsEmptied(const std::string& path) {
  constexpr int kLooks = 100;
  for (int look = 0; look < kLooks; ++look) {
    std::error_code failure;
    if (std::filesystem::file_size(path, failure) != 0 || failure) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace

Outcome<std::unique_ptr<SqlStore>> OpenStore(const StoreLocation& location, const Clock& clock) {
  if (!location.is_postgres() && IsEmptied(location.sqlite_path)) {
    return Error{ErrorCode::kFailedPrecondition, "the store " + location.sqlite_path +
                                                     " is an empty file: its solves are lost; put a backup in its " +
                                                     "place (rollgaitd restore), or remove it to begin anew"};
  }
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
  std::unique_ptr<DiskReserve> reserve;
  if (!location.is_postgres()) {
    const int64_t bytes = std::min(kMostDeletionReserve, location.reserve_bytes / 4);
    if (bytes > 0) reserve = std::make_unique<DiskReserve>(location.sqlite_path + "-reserve", bytes);
  }
  return SqlStore::Open(std::make_unique<Database>(std::move(options)), clock, RoomOf(location), std::move(reserve));
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
