#include "client/formats/format_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "client/failure.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

TEST(FormatTableTest, EveryRowWrites) {
  const v1::Solve solve = SampleSolve("solves/a", 0.1);
  std::set<std::string> names;
  for (const Format& format : Formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_FALSE(format.what.empty()) << format.name;
    const int functions =
        (format.of_model != nullptr) + (format.of_solve != nullptr) + (format.folder_of_solve != nullptr);
    EXPECT_EQ(functions, 1) << format.name;
    EXPECT_EQ(format.ending.empty(), format.folder_of_solve != nullptr) << format.name;
    const std::vector<ExportedFile> files = ExportSolve(solve, format);
    EXPECT_EQ(files.size() > 1, format.folder_of_solve != nullptr) << format.name;
    for (const ExportedFile& file : files) {
      EXPECT_EQ(file.name.empty(), files.size() == 1) << format.name;
      EXPECT_GT(file.content.size(), 200u) << format.name << " " << file.name;
    }
    EXPECT_EQ(&FindFormat(format.name), &format);
    EXPECT_THAT(SolveFormatNames(), HasSubstr(format.name));
  }
}

TEST(FormatTableTest, EndingsMeanTheFirstRow) {
  EXPECT_EQ(FormatOfPath("a.csv", "--output").name, "csv");
  EXPECT_EQ(FormatOfPath("b/a.mot", "--output").name, "mot");
  try {
    FormatOfPath("walk.docx", "--output");
    FAIL() << "took .docx";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_THAT(failure.what(), HasSubstr("--output walk.docx: the name must end in one of .json, .csv, .sto"));
  }
  EXPECT_THROW(FormatOfPath("walk", "--output"), Failure);
  EXPECT_THROW(FindFormat("fbx"), Failure);
}

TEST(FormatTableTest, SaysWhatIsMissing) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THROW(FindModelFormat("bvh"), Failure);
  EXPECT_NE(FindModelFormat("osim").of_model, nullptr);
  EXPECT_EQ(ModelFormatNames(), "mjcf, urdf, urdf-side, osim");
  solve.mutable_result()->clear_trajectory();
  for (const Format& format : Formats()) {
    if (format.name == "json") continue;
    try {
      ExportSolve(solve, format);
      ADD_FAILURE() << format.name << " without a trajectory";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kNoSolution) << format.name;
    }
  }
  EXPECT_EQ(ExportSolve(solve, FindFormat("json")).size(), 1u);
}

// What shows bodies says no to feet that it cannot show as they are; what does not shows the motion.
TEST(FormatTableTest, FormatsThatShowBodiesRefuseSuperellipsoids) {
  v1::Solve solve = SampleSolve("solves/a", 0.1);
  v1::Surface& surface = *solve.mutable_result()->mutable_model()->mutable_contacts(0)->mutable_surface();
  const v1::Vector3 axes = surface.ellipsoid().semi_axes_m();
  v1::Superellipsoid& super = *surface.mutable_superellipsoid();
  *super.mutable_semi_axes_m() = axes;
  super.set_exponent_1(0.8);
  super.set_exponent_2(0.8);
  super.set_smoothing(0.1);
  std::set<std::string> refused;
  for (const Format& format : Formats()) {
    try {
      ExportSolve(solve, format);
    } catch (const Failure& failure) {
      refused.insert(format.name);
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_THAT(failure.what(), HasSubstr("surface left_foot is not an ellipsoid, and this format shows no other"));
    }
  }
  EXPECT_EQ(refused, (std::set<std::string>{"glb", "gltf", "mcap", "mjcf", "opensim", "osim"}));
}

}  // namespace
}  // namespace rollgait::client
