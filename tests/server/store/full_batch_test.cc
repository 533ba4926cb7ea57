// A batch that has no room does not keep others waiting while it is written and undone.
#include <gtest/gtest.h>

#include <string_view>

#include "server/store/sql_store.h"
#include "server/store/sqlite_connection.h"
#include "tests/server/store/fake_clock.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

class CountingConnection : public SqliteConnection {
 public:
  CountingConnection(const std::string& path, const Clock& clock, int* inserts)
      : SqliteConnection(path, clock), inserts_(inserts) {}
  SqlStatement& Prepared(const char* sql) override {
    if (std::string_view(sql).rfind("INSERT INTO solves", 0) == 0) ++*inserts_;
    return SqliteConnection::Prepared(sql);
  }

 private:
  int* const inserts_;
};

class FullBatchTest : public testing::Test {
 protected:
  FullBatchTest() {
    Database::Options options;
    options.connect = [this] {
      return std::make_unique<CountingConnection>(directory_.path() + "/solves.db", clock_, &inserts_);
    };
    store_ = SqlStore::Open(std::make_unique<Database>(std::move(options)), clock_).value();
  }

  static std::vector<NewSolve> Batch(const std::string& name, int count, int max_queued, int max_queued_tenant) {
    std::vector<NewSolve> solves;
    for (int i = 0; i < count; ++i) {
      const std::string id = name + std::to_string(i);
      solves.push_back({id, "request " + id, "spec", "key " + id, max_queued});
      solves.back().actor.tenant = "red";
      solves.back().max_queued_tenant = max_queued_tenant;
    }
    return solves;
  }

  const TemporaryDirectory directory_;
  const FakeClock clock_;
  int inserts_ = 0;
  std::unique_ptr<SqlStore> store_;
};

TEST_F(FullBatchTest, IsRefusedBeforeAnyOfItIsWritten) {
  ASSERT_TRUE(store_->CreateAll(Batch("a", 5, 8, 0)).ok());
  ASSERT_EQ(inserts_, 5);
  const auto refused = store_->CreateAll(Batch("b", 4, 8, 100));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "there is no room for all of 4 requests: with the first 3 of them 8 solves are queued, the limit is 8; try "
            "again later");
  EXPECT_FALSE(refused.error().quota.has_value());
  const auto of_tenant = store_->CreateAll(Batch("b", 4, 100, 7));
  ASSERT_FALSE(of_tenant.ok());
  EXPECT_EQ(
      of_tenant.error().message,
      "there is no room for all of 4 requests: with the first 2 of them 7 solves of tenant \"red\" are queued, its "
      "limit is 7; try again later");
  EXPECT_TRUE(of_tenant.error().quota.has_value());
  EXPECT_FALSE(store_->CreateAll(Batch("b", 1, 5, 0)).ok());
  EXPECT_FALSE(store_->CreateAll(Batch("b", 1, 3, 0)).ok()) << "a limit that was lowered";
  EXPECT_EQ(inserts_, 5);
}

TEST_F(FullBatchTest, TakesWhatNeedsNoPlace) {
  ASSERT_TRUE(store_->CreateAll(Batch("a", 5, 8, 0)).ok());
  std::vector<NewSolve> batch = Batch("a", 5, 8, 8);
  for (const NewSolve& solve : Batch("b", 3, 8, 8)) batch.push_back(solve);
  batch.push_back(batch.back());
  const auto made = store_->CreateAll(batch);
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_EQ(made.value().back().record.id, "b2");
  EXPECT_EQ(inserts_, 8);
}

}  // namespace
}  // namespace rollgait::server
