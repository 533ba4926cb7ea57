#ifndef ROLLGAIT_SERVER_STORE_SQLITE_BACKUP_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_BACKUP_H_

#include <cstdint>
#include <string>

#include "server/base/data_dir.h"
#include "server/base/outcome.h"

namespace rollgait::server {

// What a copy of a store holds.
struct StoreCopy {
  int schema_version = 0;
  int64_t solves = 0, results = 0;
  int64_t bytes = 0;  // of the file
};

// Writes the file `to`: one snapshot of the SQLite store in `from`, with everything that was acknowledged before the
// call; servers and agents go on meanwhile. The file appears under its name when it is whole, checked and on the disk.
// kAlreadyExists: `to` is there. kNotFound: there is no store. kResourceExhausted: the disk is full.
Outcome<StoreCopy> BackUpStore(const DataDir& from, const std::string& to);

// Makes the copy `from`, which stays, the store of `to`. It is checked first, and the store appears when it is whole.
// kFailedPrecondition: a rollgaitd serves that directory, an agent works there, or it has a store that is not an empty
// file; or the copy is damaged or of a newer version. kNotFound: there is no copy.
Outcome<StoreCopy> RestoreStore(const std::string& from, const DataDir& to);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_BACKUP_H_
