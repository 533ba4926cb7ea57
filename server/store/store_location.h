#ifndef ROLLGAIT_SERVER_STORE_STORE_LOCATION_H_
#define ROLLGAIT_SERVER_STORE_STORE_LOCATION_H_

#include <cstdint>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// Where the solves are: an SQLite file or a PostgreSQL database.
struct StoreLocation {
  std::string sqlite_path = {};
  std::string postgres_url = {};  // empty: SQLite
  int connections = 8;            // most at once for writing, and as many for reading; SQLite has one writer

  // SQLite: new solves are refused while the disk has less free. A quarter of it besides, at most 16 MiB, is a file
  // beside the store that is given up when the disk is full and something is to be deleted.
  int64_t reserve_bytes = 0;

  bool is_postgres() const { return !postgres_url.empty(); }
  // For logs: without a password.
  std::string Name() const;
};

// What the flag --store means: empty is the SQLite file of the data directory. kInvalidArgument: no such engine, or not
// a URL.
Outcome<StoreLocation> LocateStore(const std::string& flag, const std::string& data_dir);

// The environment variable that says the same as --store, and keeps a password out of the list of processes.
inline constexpr char kStoreVariable[] = "ROLLGAIT_STORE";

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_STORE_LOCATION_H_
