#include "server/base/solver_choice.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

void MakeProgram(const std::string& path) {
  std::ofstream(path) << "#!/bin/sh\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
}

// What the kernel says of the processor, not the compiler's run time.
bool ProcessorHasV3() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("flags", 0) != 0) continue;
    bool all = true;
    for (const char* flag : {" avx2", " bmi1", " bmi2", " f16c", " fma", " abm", " movbe", " xsave"}) {
      all = all && (line + " ").find(std::string(flag) + " ") != std::string::npos;
    }
    return all;
  }
  return false;
}

const bool kFast = ROLLGAIT_HAS_X86_64_V3 != 0 && ProcessorHasV3();

TEST(SolverChoiceTest, TheFastestThatTheProcessorRuns) {
  const TemporaryDirectory folder;
  MakeProgram(folder.path() + "/rollgait-solve");
  MakeProgram(folder.path() + "/rollgait-solve-v3");
  const auto choice = ChooseSolver(folder.path(), "auto");
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice.value().program, folder.path() + (kFast ? "/rollgait-solve-v3" : "/rollgait-solve"));
  EXPECT_EQ(choice.value().set == InstructionSet::kX8664V3, kFast);
  EXPECT_EQ(choice.value().remark, "");
}

TEST(SolverChoiceTest, AMissingFastOneIsSaid) {
  const TemporaryDirectory folder;
  MakeProgram(folder.path() + "/rollgait-solve");
  const auto choice = ChooseSolver(folder.path(), "auto");
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice.value().program, folder.path() + "/rollgait-solve");
  EXPECT_EQ(choice.value().remark.find("rollgait-solve-v3 is missing") != std::string::npos, kFast);
  const auto wanted = ChooseSolver(folder.path(), "x86-64-v3");
  ASSERT_FALSE(wanted.ok());
  EXPECT_NE(wanted.error().message.find("--instruction-set x86-64-v3: "), std::string::npos);
}

TEST(SolverChoiceTest, TheWishWins) {
  const TemporaryDirectory folder;
  MakeProgram(folder.path() + "/rollgait-solve");
  MakeProgram(folder.path() + "/rollgait-solve-v3");
  const auto baseline = ChooseSolver(folder.path(), "baseline");
  ASSERT_TRUE(baseline.ok());
  EXPECT_EQ(baseline.value().program, folder.path() + "/rollgait-solve");
  EXPECT_EQ(ChooseSolver(folder.path(), "x86-64-v3").ok(), kFast);
}

TEST(SolverChoiceTest, TheBuildNamesItsInstructionSet) {
  EXPECT_EQ(SolverBuild(InstructionSet::kBaseline).find("x86-64-v3"), std::string::npos);
  EXPECT_NE(SolverBuild(InstructionSet::kX8664V3).find(", x86-64-v3)"), std::string::npos);
  EXPECT_EQ(SolverBuild(), SolverBuild(OwnInstructionSet()));
}

}  // namespace
}  // namespace rollgait::server
