// A disk that is full: what can still be deleted.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "server/store/open_store.h"
#include "tests/server/store/small_disk.h"
#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

class FullDiskTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!disk_.reason().empty()) GTEST_SKIP() << "this user may not mount a small disk: " << disk_.reason();
    location_.sqlite_path = disk_.path() + "/rollgait.db";
    location_.reserve_bytes = 32 << 20;
  }
  // Finished solves, and one that runs and writes until nothing more can be written.
  void FillUp(SqlStore& store) {
    for (size_t i = 0; i < 8; ++i) {
      ASSERT_TRUE(store.Create({Numbered("s", i), "", "spec", ""}).ok());
      const Lease lease = store.ClaimNext("agent", kLeaseDuration).value().value().lease;
      ASSERT_TRUE(store.Finish(lease, {}, {SolveState::kSucceeded, std::string(300'000, 'r'), "", false}).ok());
    }
    ASSERT_TRUE(store.Create({"runs", "", "spec", ""}).ok());
    ASSERT_TRUE(store.Create({"waits", "", "spec", ""}).ok());
    const Lease lease = store.ClaimNext("agent", kLeaseDuration).value().value().lease;
    disk_.Fill();
    StoredEvent event = IterationEvent(0);
    for (const size_t size : {100'000, 10'000, 1'000, 1}) {
      event.payload = std::string(size, 'e');
      for (int i = 0; i < 10'000 && store.AppendEvents(lease, {event}).ok(); ++i) {
      }
    }
    ASSERT_EQ(store.AppendEvents(lease, {event}).error().code, ErrorCode::kResourceExhausted);
  }

  SmallDisk disk_{64};
  FakeClock clock_;
  StoreLocation location_;
};

TEST_F(FullDiskTest, SolvesCanBeDeletedAndTheRestGoesOn) {
  const auto store = OpenStore(location_, clock_).value();
  EXPECT_EQ(std::filesystem::file_size(location_.sqlite_path + "-reserve"), 8u << 20);
  FillUp(*store);
  EXPECT_EQ(store->Create({"new", "", "spec", ""}).error().code, ErrorCode::kResourceExhausted);
  EXPECT_TRUE(store->RequestCancel("waits").ok());
  for (size_t i = 0; i < 8; ++i) {
    const Outcome<Done> deleted = store->Delete(Numbered("s", i));
    EXPECT_TRUE(deleted.ok()) << deleted.error().message;
  }
  EXPECT_TRUE(store->Delete("waits").ok());
  std::filesystem::remove(disk_.path() + "/filler");
  EXPECT_TRUE(store->Create({"new", "", "spec", ""}).ok());
  EXPECT_EQ(std::filesystem::file_size(location_.sqlite_path + "-reserve"), 8u << 20) << "it is taken again";
}

TEST_F(FullDiskTest, RetentionMakesRoom) {
  const auto store = OpenStore(location_, clock_).value();
  FillUp(*store);
  RetentionLimits limits;
  limits.solve_bytes = 1'000'000;
  const Outcome<Removed> removed = store->Retain(limits);
  ASSERT_TRUE(removed.ok()) << removed.error().message;
  EXPECT_GT(removed.value().solves, 3);
}

TEST_F(FullDiskTest, WithoutTheReserveNothingCanBeDeleted) {
  location_.reserve_bytes = 0;
  const auto store = OpenStore(location_, clock_).value();
  FillUp(*store);
  EXPECT_EQ(store->Delete("s0").error().code, ErrorCode::kResourceExhausted) << "so the other tests can fail";
}

}  // namespace
}  // namespace rollgait::server
