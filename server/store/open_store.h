#ifndef ROLLGAIT_SERVER_STORE_OPEN_STORE_H_
#define ROLLGAIT_SERVER_STORE_OPEN_STORE_H_

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/base/clock.h"
#include "server/base/hint_channel.h"
#include "server/store/sql_store.h"
#include "server/store/store_location.h"

namespace rollgait::server {

// Opens the store, making what is missing; an SQLite file that is there and empty is not a new store but a lost one
// (kFailedPrecondition). kUnavailable with the reason if another try may help, else another code. The
// clock outlives it.
Outcome<std::unique_ptr<SqlStore>> OpenStore(const StoreLocation& location, const Clock& clock);

// The disk of a SQLite store; of PostgreSQL none.
DiskRoom RoomOf(const StoreLocation& location);

// As OpenStore, but a PostgreSQL that is unavailable is tried again every second for as long as `wait`: after a start
// of machines the database, the network or its names may come later than their users. Every failure is a warning in the
// log. `sleep` returns early, and false, when the program is told to stop.
Outcome<std::unique_ptr<SqlStore>> AwaitStore(const StoreLocation& location, const Clock& clock,
                                              std::chrono::seconds wait,
                                              const std::function<bool(std::chrono::milliseconds)>& sleep);
constexpr int kDefaultStoreWaitSeconds = 60;
constexpr const char* kStoreWaitHelp = "Seconds to wait at the start for a PostgreSQL that cannot be reached yet";

enum class HintRole { kServer, kAgent };

// The channel by which a server and the agents of one store tell each other of news: LISTEN and NOTIFY on PostgreSQL,
// sockets in the data directory on SQLite. What a server sends reaches the agents and, on PostgreSQL, other servers.
Outcome<std::unique_ptr<HintChannel>> OpenHints(const StoreLocation& location, const std::string& data_dir,
                                                HintRole role);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_OPEN_STORE_H_
