// How often PostgreSQL is waited for, what simultaneous creates may do, and what becomes of a commit that is not
// answered.
#include "server/store/postgres_connection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "server/store/sql_store.h"
#include "tests/server/store/store_bench.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

// One for the whole program; each test has a schema of its own.
const PostgresCluster& Cluster() {
  static const PostgresCluster cluster;
  return cluster;
}

std::string UrlOfThisTest() {
  return Cluster().Url(std::string("\"") + testing::UnitTest::GetInstance()->current_test_info()->name() + '"');
}

// A store over connections that are at hand.
class OpenedStore {
 public:
  explicit OpenedStore(const std::string& url, int writers = 1, const PostgresConnection::Limits& limits = {}) {
    Database::Options options;
    options.name = "a test's";
    options.writers = writers;
    options.readers = 1;
    options.connect = [this, url, limits] {
      auto connection = std::make_unique<PostgresConnection>(url, limits);
      const std::lock_guard<std::mutex> lock(mutex_);
      connections_.push_back(connection.get());
      return connection;
    };
    auto store = SqlStore::Open(std::make_unique<Database>(std::move(options)), clock_);
    ROLLGAIT_CHECK(store.ok());
    store_ = std::move(store).value();
  }

  SqlStore& operator*() { return *store_; }
  SqlStore* operator->() { return store_.get(); }
  // Round trips since the last call; connections must not have been lost.
  int64_t Trips() {
    int64_t all = 0;
    for (const PostgresConnection* connection : connections_) all += connection->round_trips();
    return all - std::exchange(counted_, all);
  }
  // A connection costs one by itself.
  void Connect() {
    ASSERT_TRUE(store_->Counts().ok());
    Trips();
  }

 private:
  FakeClock clock_;
  std::mutex mutex_;
  std::vector<PostgresConnection*> connections_;
  int64_t counted_ = 0;
  std::unique_ptr<SqlStore> store_;
};

NewSolve Complete(const std::string& id, const std::string& key) {
  NewSolve solve{id, "request " + id, "spec", key};
  solve.warm_start = "warm";
  solve.actor = {"tenant", "token", "peer"};
  solve.max_queued_tenant = 1000;
  return solve;
}

TEST(PostgresRoundTripTest, ACreateWaitsTwice) {
  OpenedStore store(UrlOfThisTest());
  store.Connect();
  ASSERT_TRUE(store->Create({"a", "", "s", ""}).ok());
  EXPECT_EQ(store.Trips(), 2) << "the first of a connection prepares its statements, too";
  ASSERT_TRUE(store->Create(Complete("b", "key")).ok());
  EXPECT_EQ(store.Trips(), 2);
  EXPECT_FALSE(store->Create(Complete("b", "key")).value().created);
  EXPECT_EQ(store.Trips(), 2) << "a retry";
  EXPECT_EQ(store->Create({"c", "", "s", "", 2}).error().code, ErrorCode::kResourceExhausted);
  EXPECT_EQ(store.Trips(), 1) << "a refusal";
  ASSERT_TRUE(store->Create({"d", "", "s", "", 3}).ok());
  EXPECT_EQ(store.Trips(), 4) << "near the limit it counts again, alone";
  const Lease first = store->ClaimNext("agent", kLeaseDuration).value().value().lease;
  const Lease second = store->ClaimNext("agent", kLeaseDuration).value().value().lease;
  ASSERT_TRUE(store->Finish(second, {}, kAnswer).ok());
  store.Trips();
  EXPECT_TRUE(store->Create(Complete("e", "key")).value().record.from_cache);
  EXPECT_EQ(store.Trips(), 2) << "answered from the store";
}

TEST(PostgresRoundTripTest, AnAgentsWritesWaitTwice) {
  OpenedStore store(UrlOfThisTest());
  for (const char* id : {"a", "b", "c"}) ASSERT_TRUE(store->Create(Complete(id, "key of " + std::string(id))).ok());
  ASSERT_TRUE(store->Create(Complete("equal", "key of a")).ok());
  store.Connect();
  const ClaimedSolve a = store->ClaimNext("agent", kLeaseDuration).value().value();
  EXPECT_EQ(store.Trips(), 2);
  EXPECT_EQ(a.warm_start, "warm");
  const Lease b = store->ClaimNext("agent", kLeaseDuration).value().value().lease;
  const Lease c = store->ClaimNext("agent", kLeaseDuration).value().value().lease;
  EXPECT_EQ(store.Trips(), 4);
  EXPECT_FALSE(store->ClaimNext("agent", kLeaseDuration).value().has_value());
  EXPECT_EQ(store.Trips(), 3) << "what waits is equal to what runs: every tenant is asked";
  ASSERT_TRUE(store->AppendEvents(a.lease, {IterationEvent(0)}).ok());
  EXPECT_EQ(store.Trips(), 2);
  ASSERT_TRUE(store->AppendEvents(a.lease, std::vector<StoredEvent>(200, IterationEvent(1))).ok());
  EXPECT_EQ(store.Trips(), 2) << "however many events";
  ASSERT_EQ(store->AppendAll({{a.lease, {IterationEvent(2)}}, {b, {IterationEvent(0)}}, {c, {}}}).value().size(), 3u);
  EXPECT_EQ(store.Trips(), 2) << "however many solves";
  ASSERT_TRUE(store->RenewLease(a.lease, kLeaseDuration).ok());
  EXPECT_EQ(store.Trips(), 2);
  ASSERT_TRUE(store->Finish(a.lease, {IterationEvent(3)}, kAnswer).ok());
  EXPECT_EQ(store.Trips(), 2) << "with the equal one that waited";
  EXPECT_TRUE(store->Get("equal").value().from_cache);
  EXPECT_EQ(store->Get("a").value().last_sequence, 206);
  store.Trips();
  EXPECT_EQ(store->Finish(a.lease, {}, kAnswer).error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(store.Trips(), 1) << "a lost lease";
  ASSERT_TRUE(store->GiveBack(b, GiveBackReason::kStopping, "").ok());
  EXPECT_EQ(store.Trips(), 2);
  ASSERT_TRUE(store->ReclaimOwner("agent").ok());
  EXPECT_EQ(store.Trips(), 2);
  ASSERT_TRUE(store->SetPriority("b", 5).ok());
  EXPECT_EQ(store.Trips(), 2);
}

TEST(PostgresRoundTripTest, AClaimWaitsTwiceWhoeverElseWaitsToo) {
  OpenedStore store(UrlOfThisTest());
  store.Connect();
  EXPECT_FALSE(store->ClaimNext("agent", kLeaseDuration).value().has_value());
  EXPECT_EQ(store.Trips(), 2) << "nothing is queued";
  for (NewSolve solve : {Complete("a", ""), Complete("b", ""), Complete("c", "")}) {
    solve.actor.tenant = solve.id;
    ASSERT_TRUE(store->Create(solve).ok());
  }
  store.Trips();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(store->ClaimNext("agent", kLeaseDuration).value().has_value());
  EXPECT_EQ(store.Trips(), 6) << "two each";
}

TEST(PostgresRoundTripTest, AClaimForATenantWithALimitCountsAgain) {
  const std::string url = UrlOfThisTest();
  OpenedStore store(url);
  PostgresConnection(url).Execute("INSERT INTO tenants (tenant, max_running) VALUES ('tenant', 1)");
  for (const char* id : {"a", "b"}) ASSERT_TRUE(store->Create(Complete(id, "")).ok());
  store.Connect();
  ASSERT_TRUE(store->ClaimNext("agent", kLeaseDuration).value().has_value());
  EXPECT_EQ(store.Trips(), 3);
  EXPECT_FALSE(store->ClaimNext("agent", kLeaseDuration).value().has_value()) << "the tenant runs as many as it may";
}

TEST(PostgresRoundTripTest, ReadsWaitOnceAndOtherWritesTwice) {
  OpenedStore store(UrlOfThisTest());
  ASSERT_TRUE(store->Create({"a", "", "s", ""}).ok());
  store.Connect();
  ASSERT_TRUE(store->Get("a").ok());
  ASSERT_EQ(store->ReadEvents("a", 0, 10).value().events.size(), 1u);
  EXPECT_EQ(store->Extent("a").value().bytes, 1);
  EXPECT_EQ(store->Counts().value().queued, 1);
  EXPECT_EQ(store->List({10, "", std::nullopt}).value().records.size(), 1u);
  EXPECT_TRUE(store->CancelRequests("agent").value().empty());
  EXPECT_EQ(store.Trips(), 6) << "one each";
  EXPECT_EQ(store->RequestCancel("a").value().state, SolveState::kCancelled);
  EXPECT_EQ(store.Trips(), 2);
  ASSERT_TRUE(store->Delete("a").ok());
  EXPECT_EQ(store.Trips(), 2);
}

TEST(PostgresConnectionTest, WhatFailsLaterFailsTheCommitAndNothingElse) {
  PostgresConnection connection(UrlOfThisTest());
  connection.Execute("CREATE TABLE one (id BIGINT PRIMARY KEY)");
  constexpr SqlConnection::Access kWrite = SqlConnection::Access::kWrite;
  static constexpr char kInsert[] = "INSERT INTO one (id) VALUES (?)";
  connection.Begin(kWrite);
  Query::Do(connection, kInsert, 1);
  connection.Commit();
  connection.Begin(kWrite);
  Query::Do(connection, kInsert, 2);
  Query::Do(connection, kInsert, 1);
  Query::Do(connection, "DELETE FROM one WHERE id = ?", 1);
  try {
    connection.Commit();
    FAIL() << "1 was there already";
  } catch (const SqlFailure& failure) {
    EXPECT_EQ(failure.kind(), SqlFailure::Kind::kConflict) << failure.what();
  }
  connection.Rollback();
  // One that nobody commits, and that would have failed.
  connection.Begin(kWrite);
  Query::Do(connection, kInsert, 1);
  connection.Rollback();
  connection.Begin(kWrite);
  Query::Do(connection, "DELETE FROM one WHERE id = ?", 7);
  Query::Do(connection, kInsert, 3);
  connection.Commit();
  Query sum(connection, "SELECT CAST(SUM(id) AS BIGINT) FROM one");
  ASSERT_TRUE(sum.Step());
  EXPECT_EQ(sum.Int(0), 1 + 3);
}

TEST(PostgresConnectionTest, AnAnswerIsNotWaitedForWithoutLimit) {
  const std::string url = UrlOfThisTest();
  OpenedStore store(url, 1, {.answer = milliseconds(2000), .commit = milliseconds(2000)});
  ASSERT_TRUE(store->Create({"a", "", "s", ""}).ok());
  PostgresConnection other(url);
  other.Begin(SqlConnection::Access::kWrite);
  Query::Do(other, "LOCK TABLE solves IN ACCESS EXCLUSIVE MODE");
  ASSERT_TRUE(Query(other, "SELECT 1").Step());
  const auto get = store->Get("a");
  ASSERT_FALSE(get.ok());
  EXPECT_EQ(get.error().code, ErrorCode::kUnavailable) << get.error().message;
  const auto create = store->Create({"b", "", "s", ""});
  ASSERT_FALSE(create.ok());
  EXPECT_EQ(create.error().code, ErrorCode::kUnavailable) << create.error().message;
  EXPECT_EQ(create.error().message.find("commit"), std::string::npos) << "nothing was asked to be committed";
  other.Rollback();
  ASSERT_TRUE(Query(other, "SELECT 1").Step()) << "it has let go of the table";
  EXPECT_EQ(store->Get("a").value().id, "a");
}

// Inserts take a moment, so that those which are made at once overlap.
constexpr char kSlowInserts[] =
    "CREATE FUNCTION take_time() RETURNS trigger LANGUAGE plpgsql AS "
    "'BEGIN PERFORM pg_sleep(0.02); RETURN NEW; END';"
    "CREATE TRIGGER take_time BEFORE INSERT ON solves FOR EACH ROW EXECUTE FUNCTION take_time();";

// Creates from eight threads of four servers until each is refused: how many were accepted.
int CreatesAtOnce(const std::string& url, const NewSolve& like) {
  std::vector<std::unique_ptr<OpenedStore>> stores;
  for (int i = 0; i < 4; ++i) stores.push_back(std::make_unique<OpenedStore>(url, 2));
  std::atomic<int> accepted{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0;; ++i) {
        NewSolve solve = like;
        solve.id = like.id + std::to_string(t) + "-" + std::to_string(i);
        const auto created = (*stores[static_cast<size_t>(t % 4)])->Create(solve);
        if (!created.ok()) {
          EXPECT_EQ(created.error().code, ErrorCode::kResourceExhausted) << created.error().message;
          return;
        }
        ++accepted;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return accepted;
}

// With room for all connections the creates go on beside each other, and with less one after the other.
TEST(PostgresQueueLimitTest, SimultaneousCreatesDoNotExceedIt) {
  const PostgresCluster cluster({.settings = {"max_connections=20"}});
  OpenedStore store(cluster.Url());
  ASSERT_TRUE(store->Create({"first", "", "s", ""}).ok());
  cluster.Execute(kSlowInserts);
  for (const int limit : {2, 19, 30}) {
    const int queued = store->Counts().value().queued;
    NewSolve like{"l" + std::to_string(limit) + "-", "", "s", ""};
    like.max_queued = limit;
    EXPECT_EQ(CreatesAtOnce(cluster.Url(), like), limit - queued);
    EXPECT_EQ(store->Counts().value().queued, limit);
  }
  for (const int limit : {3, 25}) {
    NewSolve like{"t" + std::to_string(limit) + "-", "", "s", ""};
    like.actor.tenant = "tenant " + std::to_string(limit);
    like.max_queued_tenant = limit;
    EXPECT_EQ(CreatesAtOnce(cluster.Url(), like), limit);
  }
}

// No standby of this name exists, so no commit ends.
class PostgresWithoutStandby : public testing::Test {
 protected:
  void LoseStandby() {
    cluster_.Execute("ALTER SYSTEM SET synchronous_standby_names = 'absent'");
    cluster_.Execute("SELECT pg_reload_conf()");
  }
  void ForgetStandby() {
    cluster_.Execute("ALTER SYSTEM RESET synchronous_standby_names");
    cluster_.Execute("SELECT pg_reload_conf()");
  }
  // The server heeds its new settings in its own time.
  Outcome<CreatedSolve> CreateUntil(bool good, const std::string& id, const std::string& request_id) {
    for (int i = 0;; ++i) {
      auto created = store_->Create({id + std::to_string(i), request_id, "s", ""});
      if (created.ok() == good || i == 300) return created;
      std::this_thread::sleep_for(milliseconds(50));
    }
  }
  // How many there are, once they are no more than `most`: the server ends each in its own time, and a call on the
  // store lets go of those whose answer has come.
  int Connections(int most) {
    for (int i = 0;; ++i) {
      EXPECT_TRUE(store_->Counts().ok()) << "reads go on";
      const std::string count =
          cluster_.Execute("SELECT count(*) FROM pg_stat_activity WHERE application_name = 'rollgait'");
      if (std::stoi(count) <= most || i == 300) return std::stoi(count);
      std::this_thread::sleep_for(milliseconds(50));
    }
  }

  PostgresCluster cluster_;
  OpenedStore store_{cluster_.Url(), 2, {.answer = milliseconds(5000), .commit = milliseconds(1000)}};
};

TEST_F(PostgresWithoutStandby, ACommitThatIsNotAnsweredIsUnknownAndARetryFindsOut) {
  LoseStandby();
  ASSERT_FALSE(CreateUntil(false, "probe", "").ok());
  const auto lost = store_->Create({"lost", "request", "s", ""});
  ASSERT_FALSE(lost.ok());
  EXPECT_EQ(lost.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(lost.error().message.find("request_id"), std::string::npos) << lost.error().message;
  EXPECT_EQ(store_->Get("lost").error().code, ErrorCode::kNotFound) << "what no standby has is not shown";
  const auto again = store_->Create({"again", "request", "s", ""});
  ASSERT_FALSE(again.ok()) << "nor acknowledged";
  EXPECT_EQ(again.error().code, ErrorCode::kUnavailable);
  ForgetStandby();
  const auto found = CreateUntil(true, "retry", "request");
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_FALSE(found.value().created);
  EXPECT_EQ(found.value().record.id, "lost");
  EXPECT_EQ(store_->Get("again").error().code, ErrorCode::kNotFound);
}

TEST_F(PostgresWithoutStandby, CommitsThatHangDoNotTakeAllConnectionsOfTheServer) {
  LoseStandby();
  ASSERT_FALSE(CreateUntil(false, "probe", "").ok());
  for (int i = 0; i < 10; ++i) {
    const auto refused = store_->Create({"more" + std::to_string(i), "", "s", ""});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable) << refused.error().message;
  }
  EXPECT_LE(Connections(5), 2 * 2 + 1) << "two waiting for each of two for writing, and one for reading";
  ForgetStandby();
  ASSERT_TRUE(CreateUntil(true, "after", "").ok());
  EXPECT_LE(Connections(3), 2 + 1) << "those that waited are done with";
}

}  // namespace
}  // namespace rollgait::server
