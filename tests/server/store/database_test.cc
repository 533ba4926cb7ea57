#include "server/store/database.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <mutex>
#include <thread>

#include "server/base/executor.h"
#include "server/store/sqlite_connection.h"
#include "tests/server/store/fake_clock.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

// What happened, in order: a letter for the body of a write, a bar for a commit.
class Record {
 public:
  void Add(char what) {
    const std::lock_guard<std::mutex> lock(mutex_);
    text_ += what;
  }
  std::string text() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return text_;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

class RecordingConnection : public SqliteConnection {
 public:
  RecordingConnection(const std::string& path, const Clock& clock, Record& record)
      : SqliteConnection(path, clock), record_(record) {}
  void Commit() override {
    SqliteConnection::Commit();
    record_.Add('|');
  }

 private:
  Record& record_;
};

class DatabaseGroupTest : public testing::Test {
 protected:
  DatabaseGroupTest() : database_(OptionsOf()) {
    EXPECT_TRUE(Create().ok());
    record_before_ = record_.text().size();
  }

  Outcome<Done> Create() {
    return database_.Write([](SqlConnection& connection) -> Outcome<Done> {
      connection.Execute("CREATE TABLE written (name TEXT)");
      return Done{};
    });
  }

  // A write of the lane, whose name is a letter; its body takes so long.
  void Post(char lane, milliseconds takes = milliseconds(0)) {
    executor_.Post(std::string(1, lane), [this, lane, takes] {
      const Outcome<Done> done = database_.Write([&](SqlConnection& connection) -> Outcome<Done> {
        record_.Add(lane);
        std::this_thread::sleep_for(takes);
        Query::Do(connection, "INSERT INTO written (name) VALUES (?)", std::string(1, lane));
        return Done{};
      });
      EXPECT_TRUE(done.ok());
    });
  }
  // A write of lane a that holds the writer until the gate opens, and after it those of `lanes` in this order.
  void QueueBehindAHeldWrite(const std::string& lanes, milliseconds takes) {
    std::promise<void> started;
    executor_.Post("a", [&] {
      const Outcome<Done> done = database_.Write([&](SqlConnection&) -> Outcome<Done> {
        record_.Add('a');
        started.set_value();
        gate_.get_future().wait();
        return Done{};
      });
      EXPECT_TRUE(done.ok());
    });
    started.get_future().wait();
    for (size_t i = 0; i < lanes.size(); ++i) {
      Post(lanes[i], takes);
      while (database_.waiting_writes() < i + 1) std::this_thread::yield();
    }
    gate_.set_value();
    EXPECT_TRUE(executor_.WaitIdle(std::chrono::minutes(1)));
  }
  std::string Happened() const { return record_.text().substr(record_before_); }
  int64_t Rows() {
    return database_
        .ReadOne([](SqlConnection& connection) -> Outcome<int64_t> {
          Query query(connection, "SELECT COUNT(*) FROM written");
          return query.Step() ? query.Int(0) : -1;
        })
        .value();
  }

  const TemporaryDirectory directory_;
  const FakeClock clock_;
  Record record_;
  size_t record_before_ = 0;
  std::promise<void> gate_;
  Database database_;
  Executor executor_{16, 1000};

 private:
  Database::Options OptionsOf() {
    Database::Options options;
    options.group_writes = true;
    options.connect = [this] {
      return std::make_unique<RecordingConnection>(directory_.path() + "/a.db", clock_, record_);
    };
    return options;
  }
};

TEST_F(DatabaseGroupTest, WritesOfOneLaneShareACommit) {
  QueueBehindAHeldWrite("aaa", milliseconds(2));
  EXPECT_EQ(Happened(), "a|aaa|");
  EXPECT_EQ(Rows(), 3);
}

TEST_F(DatabaseGroupTest, ALaneThatWritesMuchWaitsBehindOneThatWritesLittle) {
  const auto start = std::chrono::steady_clock::now();
  QueueBehindAHeldWrite("aaaab", milliseconds(2));  // twice what a group may take while lanes share the writer
  const auto took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(Happened().substr(0, 4), "a|ab") << Happened();
  EXPECT_EQ(Rows(), 5);
  if (took > milliseconds(900)) GTEST_SKIP() << "so slow that the lanes no longer count as sharing the writer";
  EXPECT_EQ(Happened(), "a|ab|a|a|a|");
}

TEST_F(DatabaseGroupTest, ShortWritesOfSeveralLanesShareACommit) {
  QueueBehindAHeldWrite("bcdab", milliseconds(0));
  EXPECT_EQ(Happened().substr(0, 6), "a|bcda") << Happened();
  EXPECT_EQ(Rows(), 5);
}

}  // namespace
}  // namespace rollgait::server
