#include "server/base/memory_limit.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

TEST(MemoryLimitTest, TheSmallestLimitOfTheGroupsAboveCounts) {
  const TemporaryDirectory directory;
  const std::string groups = directory.path() + "/groups", own = directory.path() + "/cgroup";
  std::filesystem::create_directories(groups + "/pod/container");
  const int64_t machine = MemoryLimit(groups, own);
  EXPECT_GT(machine, 1 << 20);
  std::ofstream(own) << "0::/pod/container\n";
  std::ofstream(groups + "/pod/container/memory.max") << "max\n";
  EXPECT_EQ(MemoryLimit(groups, own), machine);
  std::ofstream(groups + "/pod/memory.max") << "1048576\n";
  EXPECT_EQ(MemoryLimit(groups, own), 1048576);
  std::ofstream(groups + "/pod/container/memory.max") << "524288\n";
  EXPECT_EQ(MemoryLimit(groups, own), 524288);
  std::ofstream(own) << "0::/\n";
  std::ofstream(groups + "/memory.max") << "262144\n";
  EXPECT_EQ(MemoryLimit(groups, own), 262144) << "a container sees its own group as the root";
}

}  // namespace
}  // namespace rollgait::server
