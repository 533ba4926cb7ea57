#include "server/store/store_location.h"

#include "server/base/data_dir.h"
#include "server/store/postgres_url.h"

namespace rollgait::server {

std::string StoreLocation::Name() const { return is_postgres() ? WithoutPassword(postgres_url) : sqlite_path; }

Outcome<StoreLocation> LocateStore(const std::string& flag, const std::string& data_dir) {
  StoreLocation location;
  if (flag.empty()) {
    location.sqlite_path = DataDir{data_dir}.Database();
    return location;
  }
  if (!IsPostgresUrl(flag)) {
    return Error{
        ErrorCode::kInvalidArgument,
        "--store " + WithoutPassword(flag) + " is not postgresql://...; leave it out for an SQLite file in --data-dir"};
  }
  const Outcome<Done> readable = CheckPostgresUrl(flag);
  if (!readable.ok()) {
    return Error{ErrorCode::kInvalidArgument, "--store " + WithoutPassword(flag) + " " + readable.error().message};
  }
  location.postgres_url = flag;
  return location;
}

}  // namespace rollgait::server
