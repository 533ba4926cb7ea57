#include "server/store/write_turn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "server/store/sqlite_connection.h"
#include "tests/server/store/fake_clock.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

// Two connections are to SQLite what two processes are.
TEST(WriteTurnTest, AWriterWithoutAPauseLetsAnotherInAfterItsTransaction) {
  constexpr int kTimes = 20;
  const TemporaryDirectory directory;
  const FakeClock clock;
  const std::string path = directory.path() + "/rollgait.db";
  SqliteConnection(path, clock).Execute("CREATE TABLE numbers (number INTEGER)");
  std::atomic<bool> stopping{false};
  std::atomic<int> begun{0};
  std::thread busy([&] {
    SqliteConnection connection(path, clock);
    while (!stopping) {
      connection.Begin(SqlConnection::Access::kWrite);
      ++begun;
      Query::Do(connection, "INSERT INTO numbers VALUES (1)");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      connection.Commit();
    }
  });
  SqliteConnection other(path, clock);
  int most = 0;
  for (int i = 0; i < kTimes; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const int before = begun;
    other.Begin(SqlConnection::Access::kWrite);
    most = std::max(most, begun - before);
    other.Rollback();
  }
  stopping = true;
  busy.join();
  // The one under way may not have counted itself yet.
  EXPECT_LE(most, 1) << "transactions that began while the other waited";
}

TEST(WriteTurnTest, IsHeldByOneAndEndsWithItsHolder) {
  const TemporaryDirectory directory;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  WriteTurn second(directory.path() + "/turn");
  {
    WriteTurn first(directory.path() + "/turn");
    ASSERT_TRUE(first.Take(now()));
    const auto asked = now();
    EXPECT_FALSE(second.Take(asked + std::chrono::milliseconds(20)));
    EXPECT_GE(now() - asked, std::chrono::milliseconds(20));
    first.Leave();
    EXPECT_TRUE(second.Take(now()));
    second.Leave();
    ASSERT_TRUE(first.Take(now()));
  }
  EXPECT_TRUE(second.Take(now()));
  WriteTurn nowhere(directory.path() + "/no/such/turn");
  EXPECT_THROW(nowhere.Take(now()), SqlFailure);
}

}  // namespace
}  // namespace rollgait::server
