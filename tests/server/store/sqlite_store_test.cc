// What is SQLite's own.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "server/store/fair_order.h"
#include "server/store/open_store.h"
#include "server/store/schema.h"
#include "server/store/sqlite_connection.h"
#include "tests/server/store/store_bench.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

std::unique_ptr<SqlStore> OpenIn(const std::string& directory, const Clock& clock) {
  auto store = OpenStore({directory + "/rollgait.db"}, clock);
  ROLLGAIT_CHECK(store.ok());
  return std::move(store).value();
}

void PassTime(const std::string&, FakeClock& clock, std::chrono::milliseconds time) { clock.Advance(time); }

INSTANTIATE_TEST_SUITE_P(Sqlite, SolveStoreConformance, testing::Values(StoreKind{"sqlite", OpenIn, PassTime}),
                         [](const auto& kind) { return kind.param.name; });

TEST(SqliteStoreTest, FilesThatAreNotOursAreRefused) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  std::ofstream(directory.path() + "/text.db")
      << "this is a text, and longer than the header of a database would be: " << std::string(200, 'x');
  const auto text = OpenStore({directory.path() + "/text.db"}, clock);
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().code, ErrorCode::kInternal);
  EXPECT_FALSE(OpenStore({directory.path() + "/no/such/directory.db"}, clock).ok());
}

TEST(SqliteStoreTest, AnEmptyFileIsNoNewStore) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  std::ofstream(path).flush();
  const auto store = OpenStore({path}, clock);
  ASSERT_FALSE(store.ok());
  EXPECT_EQ(store.error().code, ErrorCode::kFailedPrecondition);
  EXPECT_NE(store.error().message.find(path + " is an empty file"), std::string::npos) << store.error().message;
  std::filesystem::remove(path);
  EXPECT_TRUE(OpenStore({path}, clock).ok());
}

TEST(SqliteStoreTest, ANewerSchemaVersionIsRefusedByName) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  ASSERT_TRUE(OpenStore({path}, clock).ok());
  SqliteConnection(path, clock).Execute("UPDATE schema_version SET version = 99");
  const auto newer = OpenStore({path}, clock);
  ASSERT_FALSE(newer.ok());
  EXPECT_NE(newer.error().message.find("99"), std::string::npos) << newer.error().message;
  EXPECT_NE(newer.error().message.find(path), std::string::npos) << newer.error().message;
}

// One row while it runs, none of them when there is a result, and what is kept is counted once.
TEST(SqliteStoreTest, SolutionsDoNotPileUp) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  const auto store = std::move(OpenStore({path}, clock)).value();
  SqliteConnection connection(path, clock);
  const auto number = [&](const char* sql) {
    Query query(connection, sql);
    return query.Step() ? query.Int(0) : -1;
  };
  for (const SolveState end : {SolveState::kSucceeded, SolveState::kFailed}) {
    const std::string id = end == SolveState::kSucceeded ? "a" : "b";
    ASSERT_TRUE(store->Create({id, "", "spec", "key"}).ok());
    const Lease lease = store->ClaimNext("agent", kLeaseDuration).value()->lease;
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(store->AppendAll({{lease, {}, "a solution"}}).ok());
    EXPECT_EQ(number("SELECT COUNT(*) FROM results"), 1);
    const int64_t bytes = number("SELECT bytes FROM solves");
    ASSERT_TRUE(store->Finish(lease, {}, {end, end == SolveState::kSucceeded ? "result" : "", "", false}).ok());
    EXPECT_EQ(number("SELECT COUNT(*) FROM results"), 1);
    EXPECT_GE(number("SELECT bytes FROM solves"), bytes + (end == SolveState::kSucceeded ? 6 : 10));
    ASSERT_TRUE(store->Delete(id, {}).ok());
    EXPECT_EQ(number("SELECT COUNT(*) FROM results"), 0);
  }
}

// A file as version 1 wrote it, with a solve that ended, one that runs and one that waits.
void WriteVersion1(const std::string& path, const Clock& clock) {
  SqliteConnection connection(path, clock);
  connection.Execute(R"(
    CREATE TABLE schema_version (version INTEGER NOT NULL);
    CREATE TABLE results (id INTEGER PRIMARY KEY, solve_key TEXT NOT NULL, reusable INTEGER NOT NULL,
      payload BLOB NOT NULL);
    CREATE INDEX results_by_key ON results (solve_key) WHERE reusable = 1;
    CREATE TABLE solves (
      number INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL UNIQUE, request_id TEXT UNIQUE, spec BLOB NOT NULL,
      solve_key TEXT NOT NULL, state INTEGER NOT NULL, create_time_us INTEGER NOT NULL,
      start_time_us INTEGER NOT NULL DEFAULT 0, end_time_us INTEGER NOT NULL DEFAULT 0,
      attempts INTEGER NOT NULL DEFAULT 0, crashes INTEGER NOT NULL DEFAULT 0,
      cancel_requested INTEGER NOT NULL DEFAULT 0, from_cache INTEGER NOT NULL DEFAULT 0,
      last_sequence INTEGER NOT NULL DEFAULT 0, result_id INTEGER REFERENCES results (id), error BLOB, owner TEXT,
      epoch INTEGER NOT NULL DEFAULT 0, lease_boot_id TEXT, lease_end_ns INTEGER);
    CREATE INDEX solves_by_state ON solves (state, number);
    CREATE INDEX solves_by_key ON solves (solve_key, state);
    CREATE INDEX solves_by_result ON solves (result_id);
    CREATE TABLE events (solve INTEGER NOT NULL REFERENCES solves (number) ON DELETE CASCADE,
      sequence INTEGER NOT NULL, kind INTEGER NOT NULL, payload BLOB NOT NULL,
      PRIMARY KEY (solve, sequence)) WITHOUT ROWID;
    INSERT INTO schema_version VALUES (1);
    INSERT INTO results VALUES (7, 'key', 1, x'616e73776572'), (8, 'limit', 0, x'080412026e6f');
    INSERT INTO solves (number, id, request_id, spec, solve_key, state, create_time_us, end_time_us, attempts,
      last_sequence, result_id) VALUES (3, 'old', 'request', x'73', 'key', 3, 11, 12, 1, 3, 7);
    INSERT INTO solves (number, id, spec, solve_key, state, create_time_us, start_time_us, attempts, last_sequence,
      owner, epoch, lease_boot_id, lease_end_ns) VALUES (4, 'runs', x'73', 'k2', 2, 11, 12, 1, 2, 'agent', 5, 'b', 9);
    INSERT INTO solves (number, id, spec, solve_key, state, create_time_us, last_sequence)
      VALUES (5, 'waits', x'73', 'k3', 1, 11, 1);
    INSERT INTO solves (number, id, spec, solve_key, state, create_time_us, end_time_us, attempts, last_sequence, result_id)
      VALUES (2, 'late', x'73', 'limit', 3, 11, 12, 1, 0, 8);
    INSERT INTO events VALUES (3, 1, 1, x''), (3, 2, 1, x''), (3, 3, 3, x''), (4, 1, 1, x''), (4, 2, 1, x''),
      (5, 1, 1, x'');)");
}

TEST(SqliteStoreTest, AFileOfVersion1IsBroughtUpInPlace) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  WriteVersion1(path, clock);
  for (int opened = 0; opened < 2; ++opened) {
    const auto store = OpenStore({path}, clock);
    ASSERT_TRUE(store.ok()) << store.error().message;
    EXPECT_EQ(store.value()->Get("old").value().result, "answer");
    EXPECT_EQ(store.value()->Get("old").value().tenant, "");
    EXPECT_EQ(store.value()->Get("old").value().termination, 0) << "its result is none";
    const SolveRecord late = store.value()->List({10, "", std::nullopt}).value().records.back();
    EXPECT_EQ(late.id, "late");
    EXPECT_EQ(late.termination, v1::TERMINATION_ITERATION_LIMIT);
    EXPECT_EQ(late.verdict, 0) << "older results have none";
    EXPECT_EQ(store.value()->ReadEvents("old", 0, 10).value().events.size(), 3u);
    EXPECT_EQ(store.value()->Counts().value().queued, 1);
    EXPECT_EQ(store.value()->Unplaced(0, 10).value().size(), 4u) << "the server gives them places";
  }
  const auto store = OpenStore({path}, clock);
  // The old lease is still good, the old request_id is known, the old result answers, and parts go with their solve.
  EXPECT_TRUE(store.value()->AppendEvents({"runs", "agent", 5}, {}).ok());
  EXPECT_FALSE(store.value()->Create({"again", "request", "s", "key"}).value().created);
  EXPECT_TRUE(store.value()->Create({"equal", "", "s", "key"}).value().record.from_cache);
  EXPECT_TRUE(store.value()->Delete("old").ok());
  SqliteConnection connection(path, clock);
  Query events(connection, "SELECT COUNT(*) FROM events WHERE solve = 3");
  ASSERT_TRUE(events.Step());
  EXPECT_EQ(events.Int(0), 0);
  Query check(connection, "PRAGMA foreign_key_check");
  EXPECT_FALSE(check.Step());
  ASSERT_TRUE(store.value()->Create({"warm", "", "s", "", 9, "start"}).ok());
}

// What version 7 has beyond version 6.
constexpr char kBackToVersion6[] =
    "DROP TABLE labels; DROP INDEX solves_by_tenant; CREATE INDEX solves_by_tenant ON solves (tenant, number); "
    "ALTER TABLE solves DROP COLUMN model; ALTER TABLE solves DROP COLUMN verdict; "
    "ALTER TABLE solves DROP COLUMN termination; UPDATE schema_version SET version = 6;";

// Version 5 is version 6 without models.
TEST(SqliteStoreTest, AFileOfVersion5GetsModels) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  ASSERT_TRUE(OpenStore({path}, clock).value()->Create({"old", "", "spec", ""}).ok());
  SqliteConnection(path, clock)
      .Execute(std::string(kBackToVersion7) + kBackToVersion6 +
               "DROP TABLE models; UPDATE schema_version SET version = 5;");
  const auto store = OpenStore({path}, clock);
  ASSERT_TRUE(store.ok()) << store.error().message;
  EXPECT_EQ(store.value()->Get("old").value().spec, "spec");
  ASSERT_TRUE(store.value()->CreateModel({"walker", "digest", "summary", "payload"}).ok());
  EXPECT_EQ(store.value()->GetModel({"", "walker"}).value().payload, "payload");
  SqliteConnection connection(path, clock);
  Query version(connection, "SELECT version FROM schema_version");
  ASSERT_TRUE(version.Step());
  EXPECT_EQ(version.Int(0), kSchemaVersion);
}

TEST(SqliteStoreTest, AFileOfVersion6GetsWhatListsFilterBy) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  FillForFilters(*OpenStore({path}, clock).value());
  SqliteConnection(path, clock).Execute(std::string(kBackToVersion7) + kBackToVersion6);
  const auto store = OpenStore({path}, clock);
  ASSERT_TRUE(store.ok()) << store.error().message;
  ExpectFiltersFindThem(*store.value());
}

TEST(SqliteStoreTest, AFileOfVersion7GetsTurnsAndPriorities) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  FillForTurns(*OpenStore({path}, clock).value());
  SqliteConnection(path, clock).Execute(kBackToVersion7);
  const auto store = OpenStore({path}, clock);
  ASSERT_TRUE(store.ok()) << store.error().message;
  ExpectTurnsAndPriorities(*store.value());
}

TEST(SqliteStoreTest, WhoseTurnItIsIsFoundAlongTheIndexOfTheQueue) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  ASSERT_TRUE(OpenStore({path}, clock).ok());
  SqliteConnection connection(path, clock);
  Query plan(connection, "EXPLAIN QUERY PLAN " ROLLGAIT_TENANTS_BY_TURN);
  int along = 0;
  while (plan.Step()) {
    const std::string step = plan.Bytes(3);
    if (step.find(" q ") == std::string::npos) continue;
    EXPECT_EQ(step.rfind("SEARCH q USING COVERING INDEX solves_queued", 0), 0u) << step;
    ++along;
  }
  EXPECT_EQ(along, 2) << "the first tenant, and the next one";
}

TEST(SqliteStoreTest, AMigrationThatFailsLeavesTheFileAsItWas) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  WriteVersion1(path, clock);
  SqliteConnection connection(path, clock);
  connection.Execute("CREATE TABLE audit (mine INTEGER)");
  EXPECT_FALSE(OpenStore({path}, clock).ok());
  Query version(connection, "SELECT version FROM schema_version");
  ASSERT_TRUE(version.Step());
  EXPECT_EQ(version.Int(0), 1);
  Query rows(connection, "SELECT COUNT(*) FROM solves JOIN events ON solve = number");
  ASSERT_TRUE(rows.Step());
  EXPECT_EQ(rows.Int(0), 6);
}

TEST(SqliteStoreTest, ARestartOfTheMachineEndsAllLeases) {
  const StoreKind kind{"sqlite", OpenIn, PassTime};
  StoreBench bench(kind);
  bench.Add("a");
  bench.Claim();
  bench.clock().Reboot("second-boot");  // its time since boot is smaller than the end of the lease
  bench.Restart();
  EXPECT_EQ(bench.store().ReclaimExpired().value(), std::vector<std::string>{"a"});
  EXPECT_EQ(bench.Get("a").state, SolveState::kQueued);
}

TEST(SqliteStoreTest, NewSolvesAreRefusedWhileTheReserveIsTouched) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  StoreLocation location{directory.path() + "/rollgait.db"};
  ASSERT_TRUE(OpenStore(location, clock).value()->Create({"a", "request", "s", ""}).ok());
  location.reserve_bytes = int64_t{1} << 60;
  const auto store = OpenStore(location, clock).value();
  const auto refused = store->Create({"b", "", "s", ""});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kResourceExhausted);
  EXPECT_TRUE(refused.error().retry_after.has_value());
  EXPECT_FALSE(store->Create({"c", "request", "s", ""}).value().created) << "a retry of one that was accepted";
  const ClaimedSolve claimed = store->ClaimNext("agent", kLeaseDuration).value().value();
  EXPECT_TRUE(store->Finish(claimed.lease, {}, {SolveState::kSucceeded, "result", "", true}).ok());
}

// The limit of a file's size stands for a full disk: SQLite meets the same failed writes.
TEST(SqliteStoreTest, AFullDiskRefusesNewWorkLosesNothingAndIsGoodAgainWhenThereIsRoom) {
  signal(SIGXFSZ, SIG_IGN);
  const TemporaryDirectory directory;
  const FakeClock clock;
  const auto store = OpenStore({directory.path() + "/rollgait.db"}, clock).value();
  ASSERT_TRUE(store->Create({"first", "", "s", ""}).ok());
  const Lease lease = store->ClaimNext("agent", kLeaseDuration).value().value().lease;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 1 << 20;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string spec(50'000, 's');
  std::vector<std::string> accepted;
  std::optional<Error> refusal;
  for (size_t i = 0; i < 1000 && !refusal.has_value(); ++i) {
    const std::string id = Numbered("s", i);
    const auto created = store->Create({id, "", spec, ""});
    if (created.ok()) accepted.push_back(id);
    if (!created.ok()) refusal = created.error();
  }
  const bool readable = store->Get("first").ok() && store->ReadEvents("first", 0, 10).ok();
  const auto unfinished = store->Finish(lease, {}, {SolveState::kSucceeded, std::string(2 << 20, 'r'), "", true});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_TRUE(refusal.has_value());
  EXPECT_EQ(refusal->code, ErrorCode::kResourceExhausted) << refusal->message;
  EXPECT_NE(refusal->message.find("no room"), std::string::npos) << refusal->message;
  EXPECT_TRUE(readable);
  ASSERT_FALSE(unfinished.ok());
  EXPECT_EQ(unfinished.error().code, ErrorCode::kResourceExhausted) << unfinished.error().message;
  EXPECT_GT(accepted.size(), 3u);
  for (const std::string& id : accepted) EXPECT_EQ(store->Get(id).value().spec, spec);
  EXPECT_TRUE(store->Finish(lease, {}, kAnswer).ok()) << "the agent's next attempt";
  EXPECT_TRUE(store->Create({"after", "", spec, ""}).ok());
}

TEST(SqliteStoreTest, WritesThatShareACommitFailByThemselves) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const auto store = OpenStore({directory.path() + "/rollgait.db"}, clock).value();
  constexpr int kThreads = 8, kEach = 40;
  std::vector<std::thread> threads;
  std::atomic<int> created{0}, refused{0};
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < kEach; ++i) {
        // Every second one asks for a place in a queue that has none.
        NewSolve solve{"t" + std::to_string(t) + "-" + std::to_string(i), "", "s", ""};
        solve.max_queued = i % 2 == 0 ? 100'000 : 0;
        const auto outcome = store->Create(solve);
        created += outcome.ok() ? 1 : 0;
        refused += !outcome.ok() && outcome.error().code == ErrorCode::kResourceExhausted ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(created, kThreads * kEach / 2);
  EXPECT_EQ(refused, kThreads * kEach / 2);
  EXPECT_EQ(store->Counts().value().queued, kThreads * kEach / 2);
  EXPECT_FALSE(store->Get("t0-1").ok());
  EXPECT_EQ(store->ReadEvents("t7-38", 0, 10).value().events.size(), 1u);
}

TEST(SqliteStoreTest, CommitsAreSynchronisedToDisk) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  SqliteConnection connection(directory.path() + "/rollgait.db", clock);
  Query mode(connection, "PRAGMA journal_mode");
  ASSERT_TRUE(mode.Step());
  EXPECT_EQ(mode.Bytes(0), "wal");
  Query synchronous(connection, "PRAGMA synchronous");
  ASSERT_TRUE(synchronous.Step());
  EXPECT_EQ(synchronous.Int(0), 2) << "2 is FULL";
}

}  // namespace
}  // namespace rollgait::server
