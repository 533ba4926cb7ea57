#include "server/base/solver_choice.h"

#include <gtest/gtest.h>

#ifdef __x86_64__
#include <cpuid.h>
#endif

#include <filesystem>
#include <fstream>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

void MakeProgram(const std::string& path) {
  std::ofstream(path) << "#!/bin/sh\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
}

// What the processor says of itself (CPUID; Intel's manual, vol. 2A), and the system of the registers that it saves
// (XGETBV), not the compiler's run time. Kernels leave flags out of /proc/cpuinfo: one of 6.18 has no "abm" where CPUID
// has LZCNT.
bool ProcessorHasV3() {
#ifdef __x86_64__
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0) return false;
  constexpr unsigned kFma = 1U << 12, kMovbe = 1U << 22, kOsXsave = 1U << 27, kF16c = 1U << 29;
  if ((c & (kFma | kMovbe | kOsXsave | kF16c)) != (kFma | kMovbe | kOsXsave | kF16c)) return false;
  if (__get_cpuid_count(7, 0, &a, &b, &c, &d) == 0) return false;
  constexpr unsigned kBmi1 = 1U << 3, kAvx2 = 1U << 5, kBmi2 = 1U << 8;
  if ((b & (kBmi1 | kAvx2 | kBmi2)) != (kBmi1 | kAvx2 | kBmi2)) return false;
  constexpr unsigned kLzcnt = 1U << 5;
  if (__get_cpuid(0x80000001, &a, &b, &c, &d) == 0 || (c & kLzcnt) == 0) return false;
  unsigned low = 0, high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  constexpr unsigned kSseAndAvx = 6;
  return (low & kSseAndAvx) == kSseAndAvx;
#else
  return false;
#endif
}

constexpr SecondSolver kFast{true, true}, kOldProcessor{true, false}, kNotBuilt{false, true};

// A folder with the solver, and the second one if it is asked for.
class SolverChoiceTest : public testing::Test {
 protected:
  void Make(bool second) {
    MakeProgram(Path("rollgait-solve"));
    if (second) MakeProgram(Path("rollgait-solve-v3"));
  }
  std::string Path(const std::string& program) const { return folder_.path() + "/" + program; }
  Outcome<SolverChoice> Choose(const std::string& wish, SecondSolver second) const {
    return ChooseSolver(folder_.path(), wish, second);
  }

 private:
  TemporaryDirectory folder_;
};

TEST_F(SolverChoiceTest, TheFastestThatTheProcessorRuns) {
  Make(true);
  const auto fast = Choose("auto", kFast);
  ASSERT_TRUE(fast.ok());
  EXPECT_EQ(fast.value().program, Path("rollgait-solve-v3"));
  EXPECT_EQ(fast.value().set, InstructionSet::kX8664V3);
  EXPECT_EQ(fast.value().remark, "");
  for (const SecondSolver& second : {kOldProcessor, kNotBuilt}) {
    const auto baseline = Choose("auto", second);
    ASSERT_TRUE(baseline.ok());
    EXPECT_EQ(baseline.value().program, Path("rollgait-solve"));
    EXPECT_EQ(baseline.value().set, InstructionSet::kBaseline);
    EXPECT_EQ(baseline.value().remark, "");
  }
}

TEST_F(SolverChoiceTest, AMissingFastOneIsSaid) {
  Make(false);
  const auto choice = Choose("auto", kFast);
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice.value().program, Path("rollgait-solve"));
  EXPECT_NE(choice.value().remark.find("rollgait-solve-v3 is missing"), std::string::npos);
  EXPECT_EQ(Choose("auto", kNotBuilt).value().remark, "");
}

TEST_F(SolverChoiceTest, TheWishWinsOrIsRefusedWithItsReason) {
  Make(true);
  EXPECT_EQ(Choose("baseline", kFast).value().program, Path("rollgait-solve"));
  EXPECT_EQ(Choose("x86-64-v3", kFast).value().program, Path("rollgait-solve-v3"));
  EXPECT_EQ(Choose("x86-64-v3", kOldProcessor).error().message,
            "--instruction-set x86-64-v3: this processor does not have it");
  EXPECT_EQ(Choose("x86-64-v3", kNotBuilt).error().message,
            "--instruction-set x86-64-v3: this build made no solver for it");
  std::filesystem::remove(Path("rollgait-solve-v3"));
  EXPECT_EQ(Choose("x86-64-v3", kFast).error().message,
            "--instruction-set x86-64-v3: " + Path("rollgait-solve-v3") + " is missing");
}

TEST_F(SolverChoiceTest, TheProcessorIsAsItSaysOfItself) { EXPECT_EQ(SecondSolverHere().runs, ProcessorHasV3()); }

TEST_F(SolverChoiceTest, TheBuildNamesItsInstructionSet) {
  EXPECT_EQ(SolverBuild(InstructionSet::kBaseline).find("x86-64-v3"), std::string::npos);
  EXPECT_NE(SolverBuild(InstructionSet::kX8664V3).find(", x86-64-v3)"), std::string::npos);
  EXPECT_EQ(SolverBuild(), SolverBuild(OwnInstructionSet()));
}

}  // namespace
}  // namespace rollgait::server
