#include "server/store/sqlite_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/server/store/solve_store_conformance.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

std::unique_ptr<SolveStore> OpenIn(const std::string& directory, const Clock& clock) {
  auto store = SqliteStore::Open(directory + "/rollgait.db", clock);
  ROLLGAIT_CHECK(store.ok());
  return std::move(store).value();
}

INSTANTIATE_TEST_SUITE_P(Sqlite, SolveStoreConformance, testing::Values(StoreKind{"sqlite", OpenIn}),
                         [](const auto& kind) { return kind.param.name; });

TEST(SqliteStoreTest, FilesThatAreNotOursAreRefused) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  std::ofstream(directory.path() + "/text.db")
      << "this is a text, and longer than the header of a database would be: " << std::string(200, 'x');
  const auto text = SqliteStore::Open(directory.path() + "/text.db", clock);
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().code, ErrorCode::kUnavailable);
  EXPECT_FALSE(SqliteStore::Open(directory.path() + "/no/such/directory.db", clock).ok());
}

TEST(SqliteStoreTest, AnotherSchemaVersionIsRefused) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  ASSERT_TRUE(SqliteStore::Open(path, clock).ok());
  SqliteConnection(path).Execute("UPDATE schema_version SET version = 99");
  const auto newer = SqliteStore::Open(path, clock);
  ASSERT_FALSE(newer.ok());
  EXPECT_NE(newer.error().message.find("99"), std::string::npos) << newer.error().message;
}

TEST(SqliteStoreTest, AFileFromBeforeWarmStartsGetsTheirTable) {
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  ASSERT_TRUE(SqliteStore::Open(path, clock).ok());
  SqliteConnection(path).Execute("DROP TABLE warm_starts");
  const auto store = SqliteStore::Open(path, clock);
  ASSERT_TRUE(store.ok());
  ASSERT_TRUE(store.value()->Create({"a", "", "s", "", 9, "start"}).ok());
  EXPECT_EQ(store.value()->ClaimNext("agent", kLeaseDuration).value().value().warm_start, "start");
}

TEST(SqliteStoreTest, CommitsAreSynchronisedToDisk) {
  const TemporaryDirectory directory;
  SqliteConnection connection(directory.path() + "/rollgait.db");
  Query mode(connection, "PRAGMA journal_mode");
  ASSERT_TRUE(mode.Step());
  EXPECT_EQ(mode.Bytes(0), "wal");
  Query synchronous(connection, "PRAGMA synchronous");
  ASSERT_TRUE(synchronous.Step());
  EXPECT_EQ(synchronous.Int(0), 2) << "2 is FULL";
}

}  // namespace
}  // namespace rollgait::server
