#include "server/base/file_lock.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

TEST(FileLockTest, OnlyOneHoldsIt) {
  const TemporaryDirectory directory;
  const std::string path = directory.path() + "/x.lock";
  {
    const auto first = FileLock::TryAcquire(path);
    ASSERT_TRUE(first.ok());
    ASSERT_TRUE(first.value().has_value());
    const auto second = FileLock::TryAcquire(path);
    ASSERT_TRUE(second.ok());
    EXPECT_FALSE(second.value().has_value());
  }
  auto third = FileLock::TryAcquire(path);
  ASSERT_TRUE(third.value().has_value());
  third.value()->ReleaseAndRemove();
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(FileLockTest, AFileThatCannotBeMadeIsReported) {
  EXPECT_EQ(FileLock::TryAcquire("/no/such/directory/x.lock").error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace rollgait::server
