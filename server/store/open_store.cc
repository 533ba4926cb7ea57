#include "server/store/open_store.h"

#include "server/store/sqlite_connection.h"

namespace rollgait::server {

Outcome<std::unique_ptr<SqlStore>> OpenStore(const StoreLocation& location, const Clock& clock) {
  Database::Options options;
  options.name = location.sqlite_path;
  options.connect = [path = location.sqlite_path, &clock] { return std::make_unique<SqliteConnection>(path, clock); };
  return SqlStore::Open(std::make_unique<Database>(std::move(options)), clock);
}

}  // namespace rollgait::server
