// What is PostgreSQL's own.
#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "server/store/open_store.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_url.h"
#include "tests/server/store/store_bench.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::server {
namespace {

// One for the whole program.
PostgresCluster& Cluster() {
  static PostgresCluster cluster;
  return cluster;
}

// A directory of a test stands for a schema.
std::string UrlFor(const std::string& directory) {
  std::string schema = "t_" + std::filesystem::path(directory).filename().string();
  std::replace(schema.begin(), schema.end(), '-', '_');
  return Cluster().Url("\"" + schema + "\"");
}

StoreLocation LocationFor(const std::string& directory) { return LocateStore(UrlFor(directory), "").value(); }

std::unique_ptr<SqlStore> OpenIn(const std::string& directory, const Clock& clock) {
  auto store = OpenStore(LocationFor(directory), clock);
  ROLLGAIT_CHECK(store.ok());
  return std::move(store).value();
}

// The database's clock cannot be moved: the leases are.
void PassTime(const std::string& directory, FakeClock& clock, std::chrono::milliseconds time) {
  clock.Advance(time);
  PostgresConnection connection(UrlFor(directory));
  Query(connection, "UPDATE solves SET lease_end_ns = lease_end_ns - ? WHERE state = 2",
        int64_t{std::chrono::nanoseconds(time).count()})
      .Run();
}

const StoreKind kKind{"postgres", OpenIn, PassTime};

INSTANTIATE_TEST_SUITE_P(Postgres, SolveStoreConformance, testing::Values(kKind),
                         [](const auto& kind) { return kind.param.name; });

TEST(PostgresStoreTest, ANewerSchemaVersionIsRefusedByName) {
  StoreBench bench(kKind);
  const TemporaryDirectory directory;
  const FakeClock clock;
  const StoreLocation location = LocationFor(directory.path());
  ASSERT_TRUE(OpenStore(location, clock).ok());
  PostgresConnection(location.postgres_url).Execute("UPDATE schema_version SET version = 99");
  const auto newer = OpenStore(location, clock);
  ASSERT_FALSE(newer.ok());
  EXPECT_NE(newer.error().message.find("99"), std::string::npos) << newer.error().message;
}

TEST(PostgresStoreTest, TablesOfVersion6GetWhatListsFilterBy) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const StoreLocation location = LocationFor(directory.path());
  FillForFilters(*OpenStore(location, clock).value());
  PostgresConnection(location.postgres_url)
      .Execute(
          std::string(kBackToVersion7) +
          "DROP TABLE labels; DROP INDEX solves_by_tenant; CREATE INDEX solves_by_tenant ON solves (tenant, number); "
          "ALTER TABLE solves DROP COLUMN model, DROP COLUMN verdict, DROP COLUMN termination; "
          "UPDATE schema_version SET version = 6;");
  const auto store = OpenStore(location, clock);
  ASSERT_TRUE(store.ok()) << store.error().message;
  ExpectFiltersFindThem(*store.value());
}

TEST(PostgresStoreTest, TablesOfVersion7GetTurnsAndPriorities) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const StoreLocation location = LocationFor(directory.path());
  FillForTurns(*OpenStore(location, clock).value());
  PostgresConnection(location.postgres_url).Execute(kBackToVersion7);
  const auto store = OpenStore(location, clock);
  ASSERT_TRUE(store.ok()) << store.error().message;
  ExpectTurnsAndPriorities(*store.value());
}

// Opens the store of a cluster that is down. `sleep` is called between tries, with their number.
Outcome<std::unique_ptr<SqlStore>> Await(const StoreLocation& location, std::chrono::seconds wait,
                                         const std::function<bool(int)>& sleep) {
  static const FakeClock clock;
  int tries = 0;
  return AwaitStore(location, clock, wait, [&](std::chrono::milliseconds) { return sleep(++tries); });
}

TEST(PostgresStoreTest, ADatabaseThatComesLaterIsAwaitedUntilAStopOrTheEndOfTheWait) {
  PostgresCluster late;
  const StoreLocation location = LocateStore(late.Url(), "").value();
  late.Kill();
  int slept = 0;
  const auto count = [&slept](int tries) { return slept = tries, tries < 3; };
  const auto stopped = Await(location, std::chrono::seconds(60), count);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(slept, 3);
  slept = 0;
  EXPECT_FALSE(Await(location, std::chrono::seconds(0), count).ok());
  EXPECT_EQ(slept, 0);
  EXPECT_TRUE(Await(location, std::chrono::seconds(60), [&](int tries) {
                if (tries == 2) late.Start();
                return tries < 60;
              }).ok());
}

TEST(PostgresStoreTest, WhatWaitingDoesNotCureIsNotAwaited) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const StoreLocation location = LocationFor(directory.path());
  ASSERT_TRUE(OpenStore(location, clock).ok());
  PostgresConnection(location.postgres_url).Execute("UPDATE schema_version SET version = 99");
  bool slept = false;
  EXPECT_FALSE(Await(location, std::chrono::seconds(60), [&slept](int) { return slept = true; }).ok());
  EXPECT_FALSE(slept);
}

TEST(PostgresStoreTest, ManyMayMakeTheTablesAtOnce) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const StoreLocation location = LocationFor(directory.path());
  std::vector<std::thread> threads;
  std::atomic<int> opened{0};
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&] { opened += OpenStore(location, clock).ok() ? 1 : 0; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(opened, 6);
}

TEST(PostgresStoreTest, EqualRequestsThatAreClaimedAtOnceRunOnce) {
  StoreBench bench(kKind);
  for (size_t i = 0; i < 20; ++i) bench.Add(Numbered("s", i), "key");
  std::vector<std::thread> threads;
  std::atomic<int> claimed{0};
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      const auto claim = bench.store().ClaimNext("agent", kLeaseDuration);
      claimed += claim.ok() && claim.value().has_value() ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(claimed, 1);
  EXPECT_EQ(bench.store().Counts().value().running, 1);
}

TEST(PostgresStoreTest, AConnectionThatBreaksIsMadeAgain) {
  StoreBench bench(kKind);
  bench.Add("a");
  Cluster().Execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'rollgait'");
  EXPECT_EQ(bench.Get("a").state, SolveState::kQueued);
  Cluster().Execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'rollgait'");
  EXPECT_TRUE(bench.store().Create({"b", "", "s", ""}).ok()) << "the loss came before the commit";
}

TEST(PostgresStoreTest, AServerThatIsDownIsUnavailableUntilItIsBack) {
  PostgresCluster cluster;
  const SystemClock clock;
  const auto store = OpenStore(LocateStore(cluster.Url(), "").value(), clock);
  ASSERT_TRUE(store.ok());
  ASSERT_TRUE(store.value()->Create({"a", "", "s", ""}).ok());
  cluster.Kill();
  const auto down = store.value()->Get("a");
  ASSERT_FALSE(down.ok());
  EXPECT_EQ(down.error().code, ErrorCode::kUnavailable) << down.error().message;
  cluster.Start();
  EXPECT_EQ(store.value()->Get("a").value().id, "a");
  EXPECT_TRUE(store.value()->ClaimNext("agent", kLeaseDuration).value().has_value());
}

TEST(PostgresStoreTest, HintsReachTheOtherSideAndSurviveALostConnection) {
  const StoreLocation location = LocateStore(Cluster().Url(), "").value();
  const auto server = OpenHints(location, "", HintRole::kServer).value();
  const auto agent = OpenHints(location, "", HintRole::kAgent).value();
  // Sent again and again: one that nobody listens to yet is lost.
  const auto arrives = [](HintChannel& from, HintChannel& to, const std::string& text) {
    for (int i = 0; i < 1200; ++i) {
      from.Send(text);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      const std::vector<std::string> texts = to.Drain();
      if (std::find(texts.begin(), texts.end(), text) != texts.end()) return true;
    }
    return false;
  };
  EXPECT_TRUE(arrives(*server, *agent, "new"));
  EXPECT_TRUE(arrives(*agent, *server, "ended"));
  EXPECT_TRUE(arrives(*server, *server, "changed")) << "as other servers would hear it";
  Cluster().Execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'rollgait hints'");
  EXPECT_TRUE(arrives(*server, *agent, "again"));
  EXPECT_TRUE(arrives(*agent, *server, "too"));
}

TEST(PostgresUrlTest, PasswordsAreNotShown) {
  for (const std::string url :
       {"postgresql://me:s3cret@db/solves", "postgres://me:s3cret/s3cret@db:5432/x",
        "postgresql://me:s3c@s3cret@h1,h2/x", "postgresql://db/x?user=me&password=s3cret&sslmode=require",
        "postgresql://me:s3cret@/x?host=/run&sslpassword=s3cret"}) {
    const std::string shown = WithoutPassword(url);
    EXPECT_EQ(shown.find("s3c"), std::string::npos) << shown;
    EXPECT_NE(shown.find("***"), std::string::npos) << shown;
  }
  EXPECT_EQ(WithoutPassword("postgresql://me@db:5432/x"), "postgresql://me@db:5432/x");
}

TEST(PostgresUrlTest, AFlagThatIsNoStoreIsRefusedWithoutItsPassword) {
  EXPECT_EQ(LocateStore("", "/data").value().sqlite_path, "/data/rollgait.db");
  EXPECT_TRUE(LocateStore("postgresql://u:p@h1:1,h2:2/db?target_session_attrs=any", "").value().is_postgres());
  for (const std::string bad : {"mysql://me:s3cret@db/x", "postgresql://me:s3cret@db:%zz/x?no_such=1", "solves.db"}) {
    const auto refused = LocateStore(bad, "/data");
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(refused.error().message.find("--store"), std::string::npos);
    EXPECT_EQ(refused.error().message.find("s3cret"), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace rollgait::server
