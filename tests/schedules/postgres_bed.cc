#include <libpq-fe.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "core/base/check.h"
#include "server/store/postgres_connection.h"
#include "tests/schedules/event_words.h"
#include "tests/schedules/store_bed.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::server {
namespace {

// Found before the function of the same name in pg_catalog: leases expire by the scheduler's time.
constexpr char kClock[] =
    "CREATE SEQUENCE virtual_us;"
    "CREATE FUNCTION clock_timestamp() RETURNS timestamptz LANGUAGE sql VOLATILE AS "
    "'SELECT to_timestamp(last_value / 1000000.0) FROM virtual_us'";

using Answer = std::unique_ptr<PGresult, decltype(&PQclear)>;

class PostgresBed : public StoreBed, public StoreView {
 public:
  PostgresBed() : url_(cluster_.Url("virtual") + "%2Cpg_catalog"), handle_(PQconnectdb(url_.c_str()), PQfinish) {
    ROLLGAIT_CHECK(PQstatus(handle_.get()) == CONNECTION_OK);
    Run(kClock);
  }

  // Whoever meets a lock gives up at once: who holds it does not run meanwhile.
  std::unique_ptr<SqlConnection> Connect(const Clock&) override {
    auto connection = std::make_unique<PostgresConnection>(url_);
    connection->Execute("SET lock_timeout = '3ms'; SET idle_in_transaction_session_timeout = 0");
    return connection;
  }
  StoreView& view() override { return *this; }
  bool one_writer() const override { return false; }
  void SetTime(int64_t now_us) override {
    if (std::exchange(time_us_, now_us) != now_us) Run("SELECT setval('virtual_us', " + std::to_string(now_us) + ")");
  }

  void Clear() override {
    Run("DELETE FROM solves; DELETE FROM results; DELETE FROM audit; ALTER SEQUENCE solves_number_seq RESTART; "
        "ALTER SEQUENCE results_id_seq RESTART;");
    Run(kSetTenants);
  }

  std::vector<SeenSolve> Solves() override {
    const Answer answer = Run(kSelectSolves);
    std::vector<SeenSolve> solves;
    for (int row = 0; row < PQntuples(answer.get()); ++row) {
      SeenSolve seen;
      seen.number = Int(answer, row, 0);
      seen.id = PQgetvalue(answer.get(), row, 1);
      seen.key = PQgetvalue(answer.get(), row, 2);
      seen.owner = PQgetvalue(answer.get(), row, 3);
      seen.tag = PQgetvalue(answer.get(), row, 4);
      seen.state = static_cast<int>(Int(answer, row, 5));
      seen.epoch = Int(answer, row, 6);
      seen.last_sequence = Int(answer, row, 7);
      seen.trimmed = Int(answer, row, 8);
      seen.held_events = Int(answer, row, 9);
      seen.cancel_requested = Int(answer, row, 10) != 0;
      seen.result = Bytes(answer, row, 11);
      seen.error = Bytes(answer, row, 12);
      seen.tenant = PQgetvalue(answer.get(), row, 13);
      seen.priority = static_cast<int>(Int(answer, row, 14));
      solves.push_back(std::move(seen));
    }
    return solves;
  }

  std::vector<SeenEvent> Events(int64_t number, int64_t after_sequence) override {
    const Answer answer = Run("SELECT sequence, payload FROM events WHERE solve = " + std::to_string(number) +
                              " AND sequence > " + std::to_string(after_sequence) + " ORDER BY sequence");
    std::vector<SeenEvent> events;
    for (int row = 0; row < PQntuples(answer.get()); ++row) {
      events.push_back({Int(answer, row, 0), WordsOf(Bytes(answer, row, 1))});
    }
    return events;
  }

 private:
  Answer Run(const std::string& sql) {
    Answer answer(PQexec(handle_.get(), sql.c_str()), PQclear);
    const ExecStatusType status = PQresultStatus(answer.get());
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) {
      std::fprintf(stderr, "%s: %s\n", sql.c_str(), PQerrorMessage(handle_.get()));
      std::abort();
    }
    return answer;
  }
  static int64_t Int(const Answer& answer, int row, int column) {
    return std::atoll(PQgetvalue(answer.get(), row, column));
  }
  static std::string Bytes(const Answer& answer, int row, int column) {
    size_t size = 0;
    const auto* text = reinterpret_cast<const unsigned char*>(PQgetvalue(answer.get(), row, column));
    const std::unique_ptr<unsigned char, decltype(&PQfreemem)> bytes(PQunescapeBytea(text, &size), PQfreemem);
    return std::string(reinterpret_cast<const char*>(bytes.get()), size);
  }

  PostgresCluster cluster_;
  const std::string url_;
  const std::unique_ptr<PGconn, decltype(&PQfinish)> handle_;
  int64_t time_us_ = 0;
};

}  // namespace

std::unique_ptr<StoreBed> MakePostgresBed() { return std::make_unique<PostgresBed>(); }

}  // namespace rollgait::server
