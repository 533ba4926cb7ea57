// What attempts of solves have come to, for agents that do not share a spool.
#include <optional>
#include <string>

#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {

// The row of the solve is held meanwhile, so that an attempt that was taken over puts nothing in place of its
// successor's.
Outcome<Done> SqlStore::PutJournal(const Lease& lease, const std::string& journal) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<Done> {
    Query leased(connection, "SELECT number FROM solves " ROLLGAIT_IS_LEASED "{for_update}", lease.solve_id,
                 lease.owner, lease.epoch);
    if (!leased.Step()) return LeaseLost(lease);
    Query::Do(connection,
              "INSERT INTO journals (solve, epoch, payload) VALUES (?, ?, ?) "
              "ON CONFLICT (solve) DO UPDATE SET epoch = excluded.epoch, payload = excluded.payload",
              leased.Int(0), lease.epoch, Blob{journal});
    return Done{};
  });
}

Outcome<std::optional<StoredJournal>> SqlStore::ReadJournal(const std::string& id) {
  if (!CouldBeId(id)) return std::optional<StoredJournal>();
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<std::optional<StoredJournal>> {
    Query query(connection,
                "SELECT epoch, payload FROM journals WHERE solve = (SELECT number FROM solves WHERE id = ?)", id);
    if (!query.Step()) return std::optional<StoredJournal>();
    return std::optional(StoredJournal{query.Int(0), query.Bytes(1)});
  });
}

}  // namespace rollgait::server
