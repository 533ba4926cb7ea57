// The points of a scene's trade-off, the errors of simulations and their rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "client/text.h"
#include "client/tradeoff/scene_errors.h"
#include "client/tradeoff/scene_points.h"
#include "client/tradeoff/scene_row.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

TEST(ScenePointsTest, AllCombinationsTheLastAxisFastest) {
  v1::SimulationScene scene;
  const auto points = MakeScenePoints(scene, "1e-4,1e-6", "1e-8,1e-9", "projection,none");
  ASSERT_EQ(points.size(), 8u);
  EXPECT_EQ(points[1].tolerance, 1e-4);
  EXPECT_EQ(points[1].absolute, 1e-9);
  EXPECT_EQ(points[1].drift, v1::DriftControl::KIND_PROJECTION);
  EXPECT_EQ(points[7].tolerance, 1e-6);
  EXPECT_EQ(points[7].drift, v1::DriftControl::KIND_NONE);
}

TEST(ScenePointsTest, WhatIsNotAskedForIsTheScenes) {
  v1::SimulationScene scene;
  EXPECT_EQ(MakeScenePoints(scene, "1e-4", "", "").front().drift, v1::DriftControl::KIND_PROJECTION);
  EXPECT_FALSE(MakeScenePoints(scene, "1e-4", "", "").front().absolute.has_value());
  scene.set_absolute_tolerance(1e-7);
  scene.mutable_drift()->set_kind(v1::DriftControl::KIND_BAUMGARTE);
  scene.mutable_drift()->set_frequency_1_s(30);
  const ScenePoint point = MakeScenePoints(scene, "1e-4", "", "").front();
  EXPECT_EQ(point.absolute, 1e-7);
  EXPECT_EQ(point.drift, v1::DriftControl::KIND_BAUMGARTE);
  const v1::SimulationScene made = SceneOfPoint(scene, {1e-5, 1e-8, v1::DriftControl::KIND_NONE});
  EXPECT_EQ(made.tolerance(), 1e-5);
  EXPECT_EQ(made.absolute_tolerance(), 1e-8);
  EXPECT_EQ(made.drift().kind(), v1::DriftControl::KIND_NONE);
  EXPECT_EQ(made.drift().frequency_1_s(), 30);
  EXPECT_FALSE(SceneOfPoint(scene, {1e-5, std::nullopt, point.drift}).has_absolute_tolerance());
}

TEST(ScenePointsTest, TheReferenceIsTenTimesFinerThanTheFinestAndNoPoint) {
  const auto points = MakeScenePoints({}, "1e-6,1e-9,1e-4", "1e-8,1e-7", "none,projection");
  const ScenePoint reference = Finer(points);
  EXPECT_DOUBLE_EQ(reference.tolerance, 1e-10);
  EXPECT_DOUBLE_EQ(*reference.absolute, 1e-9);
  EXPECT_EQ(reference.drift, v1::DriftControl::KIND_NONE);
  for (const ScenePoint& point : points) EXPECT_GT(point.tolerance, reference.tolerance);
}

TEST(ScenePointsTest, WhatIsOutsideIsRefusedWithFlagAndLimit) {
  const auto why = [](const std::string& tolerances, const std::string& absolutes, const std::string& drifts) {
    try {
      MakeScenePoints({}, tolerances, absolutes, drifts);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      return std::string(failure.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(why("1e-13,1e-2", "1e-29", "none"), "accepted");
  EXPECT_THAT(why("1e-14", "", ""), HasSubstr("--tolerance 1e-14: 1e-14 must be in [1e-13, 1e-2]"));
  EXPECT_THAT(why("0.1", "", ""), HasSubstr("--tolerance"));
  EXPECT_THAT(why("1e-4,1e-4", "", ""), HasSubstr("has 0.0001 twice"));
  EXPECT_THAT(why("1e-4", "1e-30", ""), HasSubstr("--absolute-tolerance 1e-30: 1e-30 must be in [1e-29, 1e-2]"));
  EXPECT_THAT(why("1e-4", "", "weld"), HasSubstr("\"weld\" must be one of baumgarte, none, projection"));
  EXPECT_THAT(why("1e-4", "", "none,none"), HasSubstr("none twice"));
  EXPECT_THAT(why("1e-4", "", "baumgarte"), HasSubstr("takes frequency_1_s"));
  EXPECT_THAT(why("1e-3:1e-2:1e-5", "", ""), HasSubstr("the most are 200"));
}

// A sliding, a turning and a free joint at three instants, and an event.
class SceneErrorsTest : public testing::Test {
 protected:
  SceneErrorsTest() {
    for (const auto type : {v1::Joint::TYPE_PRISMATIC, v1::Joint::TYPE_REVOLUTE, v1::Joint::TYPE_FREE}) {
      scene_.add_joints()->set_type(type);
    }
    for (int i = 0; i < 3; ++i) {
      v1::SimulationSample& sample = *one_.add_samples();
      sample.set_time_s(i);
      for (const double q : {1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 3.0, 4.0, 5.0}) sample.add_positions(q);
      for (const double v : {1.0, 2.0, 0.0, 0.0, 0.0, 6.0, 0.0, 0.0}) sample.add_velocities(v);
    }
    Happens(one_, "foot", 1.5);
    one_.mutable_report()->set_end(v1::SimulationReport::END_DURATION);
    other_ = one_;
  }
  static void Happens(v1::Simulation& simulation, const std::string& contact, double time_s) {
    v1::SimulationEvent& event = *simulation.add_events();
    event.set_kind(v1::SimulationEvent::KIND_TOUCH_DOWN);
    event.set_contact(contact);
    event.set_time_s(time_s);
  }
  SceneErrors Errors() const { return ErrorsAgainst(scene_, one_, other_); }

  v1::SimulationScene scene_;
  v1::Simulation one_, other_;
};

TEST_F(SceneErrorsTest, NoneBetweenEquals) {
  const SceneErrors errors = Errors();
  EXPECT_EQ(errors.pose() + errors.velocity_m_s + errors.angular_velocity_deg_s, 0);
  EXPECT_EQ(errors.event_time_s, 0.0);
  EXPECT_TRUE(errors.same_motion);
}

TEST_F(SceneErrorsTest, LargestOfJointsOfEachKind) {
  other_.mutable_samples(1)->set_positions(0, 1.25);
  other_.mutable_samples(2)->set_positions(1, 1.9);
  other_.mutable_samples(2)->set_velocities(0, 0.5);
  other_.mutable_samples(2)->set_velocities(1, 2.2);
  const SceneErrors errors = Errors();
  EXPECT_NEAR(errors.position_m, 0.25, 1e-15);
  EXPECT_NEAR(errors.angle_deg, 0.1 * 180 / kPi, 1e-12);
  EXPECT_NEAR(errors.velocity_m_s, 0.5, 1e-15);
  EXPECT_NEAR(errors.angular_velocity_deg_s, 0.2 * 180 / kPi, 1e-12);
  EXPECT_NEAR(errors.pose(), 0.25, 1e-15);
  other_.mutable_samples(1)->set_positions(0, 1.01);
  EXPECT_NEAR(Errors().pose(), 0.1, 1e-12) << "the angle in rad is the larger one now";
}

// Whatever else a joint that turns does.
TEST_F(SceneErrorsTest, PositionsOfAScrewAreAngles) {
  scene_.mutable_joints(1)->set_type(v1::Joint::TYPE_SCREW);
  other_.mutable_samples(2)->set_positions(1, 1.9);
  EXPECT_NEAR(Errors().angle_deg, 0.1 * 180 / kPi, 1e-12);
  EXPECT_EQ(Errors().position_m, 0);
}

TEST_F(SceneErrorsTest, OfAFreeJointTheRotationAndVelocitiesInOneFrame) {
  // Turned by 90 degrees about z, and the same velocity in the joint frame; q and -q are one orientation.
  v1::SimulationSample& sample = *other_.mutable_samples(0);
  sample.set_positions(2, -std::sqrt(0.5));
  sample.set_positions(5, -std::sqrt(0.5));
  sample.set_velocities(5, 0);
  sample.set_velocities(6, -6);
  sample.set_positions(6, 3.3);
  sample.set_positions(7, 3.6);
  const SceneErrors errors = Errors();
  EXPECT_NEAR(errors.angle_deg, 90, 1e-12);
  EXPECT_NEAR(errors.velocity_m_s, 0, 1e-12);
  EXPECT_NEAR(errors.position_m, 0.5, 1e-12);
}

TEST_F(SceneErrorsTest, BetweenTheTimesOfOneImpactVelocitiesAreNotCompared) {
  other_.mutable_events(0)->set_time_s(2.25);
  other_.mutable_samples(2)->set_velocities(0, 100);
  EXPECT_EQ(Errors().velocity_m_s, 0);
  EXPECT_EQ(Errors().event_time_s, 0.75);
  other_.mutable_samples(1)->set_velocities(0, 3);
  EXPECT_EQ(Errors().velocity_m_s, 2);
}

TEST_F(SceneErrorsTest, OtherEventsOrAnotherEndAreAnotherMotion) {
  other_.mutable_report()->set_end(v1::SimulationReport::END_FRICTION_LOST);
  EXPECT_FALSE(Errors().same_motion);
  other_ = one_;
  Happens(other_, "hand", 1.7);
  EXPECT_FALSE(Errors().same_motion);
  EXPECT_FALSE(Errors().event_time_s.has_value());
  Happens(one_, "hand", 1.4);
  EXPECT_TRUE(Errors().same_motion) << "the order at each contact counts";
  other_.mutable_events(0)->set_kind(v1::SimulationEvent::KIND_LIFT_OFF);
  EXPECT_FALSE(Errors().same_motion);
}

TEST_F(SceneErrorsTest, SamplesThatDoNotFitAreRefused) {
  other_.mutable_samples(1)->mutable_velocities()->RemoveLast();
  EXPECT_THROW(Errors(), Failure);
  other_ = one_;
  for (auto& sample : *other_.mutable_samples()) sample.set_time_s(sample.time_s() + 0.5);
  EXPECT_THROW(Errors(), Failure);
}

TEST(SceneRowTest, HasTheErrorsBesideWhatTheReportSays) {
  const ScenePoint point{1e-6, std::nullopt, v1::DriftControl::KIND_NONE};
  v1::SimulationReport report;
  report.set_end(v1::SimulationReport::END_DURATION);
  report.set_steps(12);
  report.set_max_energy_error_j(3e-7);
  SceneErrors errors;
  errors.position_m = 0.002;
  TradeoffTable table = SceneTable("n", "finer");
  table.rows = {SceneRow(point, report, 0.25, errors, 0.0009)};
  report.set_end(v1::SimulationReport::END_TOO_MANY_STEPS);
  table.rows.push_back(SceneRow(point, report, 0.1, std::nullopt, 0.0009));
  MarkFront(table);
  EXPECT_THAT(TradeoffCsv(table),
              HasSubstr("\n1e-06,1e-06,none,duration,same,1,1,0.25,12,0,0.002,0.002,0,0,0,,3e-07,0,0\n"));
  EXPECT_THAT(TradeoffCsv(table),
              testing::EndsWith("\n1e-06,1e-06,none,too many steps,,,0,0.1,12,0,,,,,,,3e-07,0,0\n"));
  EXPECT_THAT(TradeoffText(table),
              testing::ContainsRegex("\\* +1e-06 +1e-06 +none +duration +same +0.25 +12 +0 +0.002"));
  table.rows = {SceneRow(point, report, 0.25, errors, 0.0011)};
  EXPECT_THAT(TradeoffText(table), HasSubstr("?0.002"));
  report.set_max_energy_error_j(std::nan(""));
  AddRow(table, SceneRow(point, report, 0.25, errors, 0.0009));
  EXPECT_FALSE(table.rows[1].contains("reported_energy_error_j")) << "in JSON it would be null, and 0 on the page";
  EXPECT_THAT(TradeoffCsv(table), testing::EndsWith(",,0,0\n"));
  errors.same_motion = false;
  table.rows = {SceneRow(point, report, 0.25, errors, 0.0009)};
  MarkFront(table);
  EXPECT_EQ(table.rows[0].at("on_front"), false);
}

}  // namespace
}  // namespace rollgait::client
