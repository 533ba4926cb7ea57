#include "server/store/sqlite_backup.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "server/base/file_lock.h"
#include "server/store/open_store.h"
#include "server/store/sqlite_connection.h"
#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

namespace fs = std::filesystem;

// A store in "from", and room beside it. The folder's name has what a URI would take for its own.
class SqliteBackupTest : public testing::Test {
 protected:
  SqliteBackupTest() { fs::create_directories(from_.path); }

  std::unique_ptr<SolveStore> Open(const DataDir& dir) {
    auto store = OpenStore({dir.Database()}, clock_);
    ROLLGAIT_CHECK(store.ok());
    return std::move(store).value();
  }
  void AddSolves(SolveStore& store, const std::string& prefix, int count) {
    for (int i = 0; i < count; ++i) {
      const std::string id = Numbered(prefix, static_cast<size_t>(i));
      ASSERT_TRUE(store.Create({id, "", "spec of " + id, ""}).ok());
    }
  }
  std::string Path(const std::string& name) const { return directory_.path() + "/" + name; }
  // Why a restore of the copy is refused.
  std::string Refusal(const std::string& copy) {
    const Outcome<StoreCopy> restored = RestoreStore(copy, to_);
    EXPECT_FALSE(fs::exists(to_.Database()) && fs::file_size(to_.Database()) > 0);
    return restored.ok() ? "none" : restored.error().message;
  }

  TemporaryDirectory directory_;
  FakeClock clock_;
  const DataDir from_{Path("from #1 50%?x'")}, to_{Path("to")};
};

TEST_F(SqliteBackupTest, ACopyOfALivingStoreHoldsWhatWasAcknowledged) {
  const auto store = Open(from_);
  AddSolves(*store, "before", 50);
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    const auto other = Open(from_);
    for (size_t i = 0; !stop; ++i) EXPECT_TRUE(other->Create({Numbered("during", i), "", "spec", ""}).ok());
  });
  const std::string file = Path("copy of it");
  const Outcome<StoreCopy> made = BackUpStore(from_, file);
  stop = true;
  writer.join();
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_GE(made.value().solves, 50);
  EXPECT_EQ(made.value().bytes, static_cast<int64_t>(fs::file_size(file)));
  AddSolves(*store, "after", 1);

  const Outcome<StoreCopy> restored = RestoreStore(file, to_);
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(restored.value().solves, made.value().solves);
  const auto again = Open(to_);
  for (int i = 0; i < 50; ++i) {
    const std::string id = Numbered("before", static_cast<size_t>(i));
    EXPECT_EQ(again->Get(id).value().spec, "spec of " + id);
  }
  EXPECT_EQ(again->Get("after0").error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(again->Create({"new", "", "spec", ""}).ok());
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(SqliteBackupTest, NothingIsReplaced) {
  AddSolves(*Open(from_), "s", 1);
  std::ofstream(Path("taken")) << "of somebody else";
  EXPECT_EQ(BackUpStore(from_, Path("taken")).error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(fs::file_size(Path("taken")), 16u);
  ASSERT_TRUE(BackUpStore(from_, Path("copy")).ok());
  ASSERT_TRUE(RestoreStore(Path("copy"), to_).ok());
  AddSolves(*Open(to_), "own", 1);
  const Error has_one = RestoreStore(Path("copy"), to_).error();
  EXPECT_EQ(has_one.code, ErrorCode::kFailedPrecondition);
  EXPECT_NE(has_one.message.find("has a store"), std::string::npos) << has_one.message;
  EXPECT_TRUE(Open(to_)->Get("own0").ok());
  EXPECT_EQ(BackUpStore({Path("nowhere")}, Path("x")).error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(BackUpStore(from_, Path("no/such/folder")).ok());
}

TEST_F(SqliteBackupTest, TheLogOfAStoreThatWasLostIsNotTakenForThatOfTheCopy) {
  AddSolves(*Open(from_), "s", 3);
  ASSERT_TRUE(BackUpStore(from_, Path("copy")).ok());
  fs::create_directories(to_.path);
  {
    const auto lost = Open(to_);
    AddSolves(*lost, "lost", 20);
    fs::copy_file(to_.Database() + "-wal", Path("wal"));
  }
  std::ofstream(to_.Database(), std::ios::trunc).flush();
  fs::copy_file(Path("wal"), to_.Database() + "-wal", fs::copy_options::overwrite_existing);
  ASSERT_TRUE(RestoreStore(Path("copy"), to_).ok());
  EXPECT_TRUE(Open(to_)->Get("s2").ok());
  EXPECT_FALSE(Open(to_)->Get("lost0").ok());
}

TEST_F(SqliteBackupTest, ADirectoryInUseIsRefused) {
  AddSolves(*Open(from_), "s", 1);
  ASSERT_TRUE(BackUpStore(from_, Path("copy")).ok());
  fs::create_directories(to_.AgentsDir());
  {
    const auto server = FileLock::TryAcquire(to_.ServerLock());
    ASSERT_TRUE(server.ok() && server.value());
    EXPECT_NE(Refusal(Path("copy")).find("a rollgaitd serves"), std::string::npos);
  }
  {
    const auto agent = FileLock::TryAcquire(to_.AgentLock("a-1"));
    ASSERT_TRUE(agent.ok() && agent.value());
    EXPECT_NE(Refusal(Path("copy")).find("an agent works"), std::string::npos);
  }
  EXPECT_TRUE(RestoreStore(Path("copy"), to_).ok());
}

TEST_F(SqliteBackupTest, WhatIsNoGoodCopyIsRefusedWithItsReason) {
  AddSolves(*Open(from_), "s", 200);
  const std::string copy = Path("copy");
  ASSERT_TRUE(BackUpStore(from_, copy).ok());
  const auto size = static_cast<int64_t>(fs::file_size(copy));
  fs::copy_file(copy, Path("torn"));
  fs::resize_file(Path("torn"), static_cast<uintmax_t>(size / 2));
  EXPECT_NE(Refusal(Path("torn")), "none");
  fs::copy_file(copy, Path("flipped"));
  {
    std::fstream file(Path("flipped"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(size / 2);
    file << std::string(4096, '\xff');
  }
  EXPECT_NE(Refusal(Path("flipped")), "none");
  std::ofstream(Path("text")) << "this is a text: " << std::string(500, 'x');
  EXPECT_NE(Refusal(Path("text")), "none");
  SqliteConnection(Path("other"), clock_).Execute("CREATE TABLE solves (id TEXT)");
  EXPECT_NE(Refusal(Path("other")).find("is no store of Rollgait"), std::string::npos);
  fs::copy_file(copy, Path("newer"));
  SqliteConnection(Path("newer"), clock_).Execute("UPDATE schema_version SET version = 99");
  EXPECT_NE(Refusal(Path("newer")).find("schema version 99"), std::string::npos);
  EXPECT_EQ(RestoreStore(Path("nothing"), to_).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(RestoreStore(copy, to_).ok());
}

}  // namespace
}  // namespace rollgait::server
