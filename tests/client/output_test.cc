#include "client/output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "client/accuracy_table.h"
#include "client/failure.h"
#include "client/formats/points_csv.h"
#include "client/formats/sto.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

TEST(CsvTest, OneRowAPointWithUnits) {
  const v1::Solve solve = SampleSolve("solves/a", 0);
  const std::vector<std::string> lines = Split(ToCsv(solve), '\n');
  ASSERT_EQ(lines.size(), 1u + 2 * 8 + 2 * 24);
  const std::vector<std::string> header = Split(lines[0], ',');
  ASSERT_EQ(header.size(), 2u + 3 * 9 + 6 + 6);
  EXPECT_EQ(header[0], "time [s]");
  EXPECT_EQ(header[2], "base_x position [m]");
  EXPECT_EQ(header[5], "hip_l position [rad]");
  EXPECT_EQ(header[29], "hip_l effort [N m]");
  EXPECT_EQ(header[40], "right_foot force z [N]");
  for (const std::string& line : lines) EXPECT_EQ(Split(line, ',').size(), header.size());

  const v1::TrajectoryPhase& single = solve.result().trajectory().phases(1);
  const std::vector<std::string> row = Split(lines[1 + 16 + 5], ',');
  EXPECT_NEAR(std::stod(row[0]), single.point_times_s(5), 1e-11);
  EXPECT_EQ(row[1], "1");
  EXPECT_NEAR(std::stod(row[2 + 4]), single.point_positions().values(5 * 9 + 4), 1e-11);
  EXPECT_NEAR(std::stod(row[37]), single.point_forces().values(5 * 3 + 2), 1e-8);
  EXPECT_EQ(row[40], "0");  // The right foot is in the air.
}

TEST(StoTest, HeaderIsWhatOpenSimReads) {
  const std::vector<std::string> lines = Split(ToSto(SampleSolve("solves/a", 0.1)), '\n');
  EXPECT_EQ(lines[0], "solves/a");
  EXPECT_EQ(lines[1], "version=1");
  EXPECT_EQ(lines[2], "nRows=201");
  EXPECT_EQ(lines[3], "nColumns=41");
  EXPECT_EQ(lines[4], "inDegrees=no");
  const auto end = std::find(lines.begin(), lines.end(), "endheader");
  ASSERT_NE(end, lines.end());
  ASSERT_EQ(lines.end() - end, 1 + 1 + 201);
  const std::vector<std::string> labels = Split(*(end + 1), '\t');
  EXPECT_EQ(labels.size(), 41u);
  EXPECT_EQ(labels[31], "right_ground_force_vx");
  EXPECT_EQ(labels[38], "left_ground_force_vz");
  EXPECT_EQ(labels[0], "time");
  double before = -1;
  for (auto line = end + 2; line != lines.end(); ++line) {
    const std::vector<std::string> row = Split(*line, '\t');
    ASSERT_EQ(row.size(), labels.size());
    EXPECT_GT(std::stod(row[0]), before);
    before = std::stod(row[0]);
  }
  EXPECT_NEAR(before, 2 * kSampleSpan_s, 1e-11);
  // 30 %: the right foot carries the weight, the left one swings; the numbers are those of the message.
  const std::vector<std::string> row = Split(*(end + 2 + 60), '\t');
  EXPECT_NEAR(std::stod(row[33]), 75 * 9.81, 1e-8);
  EXPECT_NEAR(std::stod(row[34]), 0.3 + 0.2 * 30 / 60, 1e-11);
  EXPECT_EQ(std::stod(row[38]), 0);
  EXPECT_EQ(row[39], "nan");
}

TEST(StoTest, WithoutEventsThereAreNoFeet) {
  v1::Solve solve = SampleSolve("solves/a", 0.1);
  solve.mutable_result()->clear_gait_events();
  EXPECT_EQ(Split(ToSto(solve), '\n')[3], "nColumns=31");
  *solve.mutable_result()->mutable_gait_events() = SampleGaitEvents(SampleModel());
  solve.mutable_result()->mutable_gait_events()->mutable_feet(0)->mutable_force_n()->set_rows(101);
  EXPECT_THROW(ToSto(solve), Failure);
}

TEST(AccuracyLinesTest, ManoeuvresHaveNoSwing) {
  const auto labels = [](const v1::Solve& solve) {
    std::vector<std::string> all;
    for (const AccuracyLine& line : AccuracyLines(solve)) all.push_back(line.name);
    return all;
  };
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(labels(solve), ::testing::Contains("least swing clearance"));
  EXPECT_THAT(labels(solve), ::testing::Not(::testing::Contains("end error")));
  const size_t lines = labels(solve).size();
  solve.mutable_spec()->mutable_manoeuvre();
  EXPECT_THAT(labels(solve), ::testing::Not(::testing::Contains("least swing clearance")));
  EXPECT_THAT(labels(solve), ::testing::Contains("end error"));
  EXPECT_EQ(labels(solve).size(), lines);
}

TEST(AccuracyLinesTest, ImpactsAreShownWhereTouchDownIsPlastic) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->mutable_accuracy()->set_impact_loss_j(12);
  const size_t lines = AccuracyLines(solve).size();
  solve.mutable_spec()->mutable_ground_contact()->set_touch_down(v1::TOUCH_DOWN_PLASTIC);
  const std::vector<AccuracyLine> with = AccuracyLines(solve);
  ASSERT_EQ(with.size(), lines + 4);
  EXPECT_EQ(with[lines].name, "energy lost in impacts");
  EXPECT_EQ(with[lines].value, 12);
}

TEST(OutputTest, RefusesWhatCannotBeWritten) {
  EXPECT_THROW(RequireOutputPath("a.txt"), Failure);
  EXPECT_THROW(RequireOutputPath("a"), Failure);
  EXPECT_THROW(RequireOutputPath(testing::TempDir() + "no_such_directory/a.csv"), Failure);
  EXPECT_NO_THROW(RequireOutputPath(testing::TempDir() + "a.csv"));
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->clear_trajectory();
  try {
    ExportSolve(solve, FindFormat("csv"));
    FAIL() << "wrote a table without a trajectory";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kNoSolution);
  }
}

}  // namespace
}  // namespace rollgait::client
