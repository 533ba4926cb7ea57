#ifndef ROLLGAIT_TESTS_SCHEDULES_STORE_BED_H_
#define ROLLGAIT_TESTS_SCHEDULES_STORE_BED_H_

#include <cstdint>
#include <memory>

#include "server/base/clock.h"
#include "server/store/sql_connection.h"
#include "tests/schedules/store_view.h"

namespace rollgait::server {

// What the model reads of the solves after a commit; SQL of both databases. Absent results and errors are empty.
inline constexpr char kSelectSolves[] =
    "SELECT number, id, solve_key, COALESCE(owner, ''), "
    "COALESCE((SELECT value FROM labels WHERE solve = number AND name = 'tag'), ''), state, epoch, last_sequence, "
    "trimmed_sequence, (SELECT COUNT(*) FROM events WHERE solve = number), cancel_requested, "
    "COALESCE((SELECT payload FROM results WHERE results.id = result_id), ''), COALESCE(error, ''), "
    "tenant, priority FROM solves ORDER BY number";

// The tenants of clients, with their weights.
struct SeenTenant {
  const char* name;
  int weight;
};
inline constexpr SeenTenant kTenants[] = {{"t0", 1}, {"t1", 3}};
inline constexpr char kSetTenants[] =
    "DELETE FROM shares; DELETE FROM tenants; INSERT INTO tenants (tenant, weight) VALUES ('t1', 3); ";

// A database for one seed after the other.
class StoreBed {
 public:
  virtual ~StoreBed() = default;
  virtual std::unique_ptr<SqlConnection> Connect(const Clock& clock) = 0;
  // Removes all rows and counts from the start again; no transaction is open.
  virtual void Clear() = 0;
  virtual StoreView& view() = 0;
  // One writer has the whole database.
  virtual bool one_writer() const = 0;
  // What its own clock shows, if it has one.
  virtual void SetTime(int64_t now_us) = 0;
};

// A file in memory (/dev/shm, if there is such a folder).
std::unique_ptr<StoreBed> MakeSqliteBed();
// A server of its own, with a clock that shows what it is told.
std::unique_ptr<StoreBed> MakePostgresBed();

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_STORE_BED_H_
