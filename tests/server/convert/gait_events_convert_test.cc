#include "server/convert/gait_events_convert.h"

#include <gtest/gtest.h>

#include "core/models/planar_human.h"

namespace rollgait::server {
namespace {

// Every number another one.
GaitEvents Events(const Scene& scene) {
  GaitEvents events;
  events.start = 0.1;
  events.duration = 1.1;
  events.displacement = 1.4;
  events.body_weight = 700;
  events.events = {{GaitEventKind::kHeelStrike, Foot::kRight, 0},
                   {GaitEventKind::kFootFlat, Foot::kRight, 7},
                   {GaitEventKind::kToeOff, Foot::kLeft, 11},
                   {GaitEventKind::kHeelOff, Foot::kLeft, 88}};
  const int left = scene.FindContact("left_foot"), right = scene.FindContact("right_foot");
  events.spans = {{0, 11, {left, right}, true, true}, {11, 60, {right}, true, false}, {60, 100, {}, false, false}};
  double value = 0;
  for (FootOnGround& foot : events.feet) {
    foot.contacts = {value == 0 ? right : left};
    foot.stance = value == 0 ? 0.6 : 0.62;
    for (const auto& [matrix, rows] :
         {std::pair{&foot.force, 3}, {&foot.level_force, 3}, {&foot.center_of_pressure, 2}}) {
      matrix->resize(rows, 4);
      for (double& entry : matrix->reshaped()) entry = value++;
    }
  }
  events.double_support = 0.11;
  events.single_support = 0.49;
  events.flight = 0.4;
  events.feet[0].step_length = 0.75;
  events.feet[1].step_length = 0.65;
  events.feet[0].step_duration = 0.5;
  events.feet[1].step_duration = 0.6;
  events.feet[0].loading = 0.05;
  events.feet[1].loading = 0.06;
  return events;
}

void ExpectInstants(const v1::Matrix& rows, const MatrixX& columns) {
  ASSERT_EQ(rows.rows(), columns.cols());
  ASSERT_EQ(rows.columns(), columns.rows());
  for (int i = 0; i < columns.cols(); ++i) {
    for (int j = 0; j < columns.rows(); ++j) EXPECT_EQ(rows.values(i * rows.columns() + j), columns(j, i));
  }
}

TEST(EncodeGaitEvents, EverythingArrives) {
  const Scene scene = PlanarHuman(Sex::kMale, 1.8, 80);
  const GaitEvents events = Events(scene);
  const v1::GaitEvents encoded = EncodeGaitEvents(events, scene);
  EXPECT_EQ(encoded.start_s(), 0.1);
  EXPECT_EQ(encoded.duration_s(), 1.1);
  EXPECT_EQ(encoded.displacement_m(), 1.4);
  EXPECT_EQ(encoded.body_weight_n(), 700);
  EXPECT_EQ(encoded.double_support_fraction(), 0.11);
  EXPECT_EQ(encoded.single_support_fraction(), 0.49);
  EXPECT_EQ(encoded.flight_fraction(), 0.4);
  EXPECT_NEAR(encoded.step_length_asymmetry(), 0.1 / 0.7, 1e-12);
  EXPECT_NEAR(encoded.step_duration_asymmetry(), -0.1 / 0.55, 1e-12);
  EXPECT_EQ(encoded.stance_asymmetry(), events.StanceAsymmetry());
  const v1::GaitEvent::Kind kinds[] = {v1::GaitEvent::KIND_HEEL_STRIKE, v1::GaitEvent::KIND_FOOT_FLAT,
                                       v1::GaitEvent::KIND_TOE_OFF, v1::GaitEvent::KIND_HEEL_OFF};
  ASSERT_EQ(encoded.events_size(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(encoded.events(i).kind(), kinds[i]);
    EXPECT_EQ(encoded.events(i).foot(), i < 2 ? v1::FOOT_RIGHT : v1::FOOT_LEFT);
    EXPECT_EQ(encoded.events(i).percent(), events.events[i].percent);
  }
  ASSERT_EQ(encoded.phases_size(), 3);
  EXPECT_EQ(encoded.phases(0).feet_size(), 2);
  EXPECT_EQ(encoded.phases(1).start_percent(), 11);
  EXPECT_EQ(encoded.phases(1).end_percent(), 60);
  ASSERT_EQ(encoded.phases(1).contacts_size(), 1);
  EXPECT_EQ(encoded.phases(1).contacts(0), "right_foot");
  ASSERT_EQ(encoded.phases(1).feet_size(), 1);
  EXPECT_EQ(encoded.phases(1).feet(0), v1::FOOT_RIGHT);
  EXPECT_EQ(encoded.phases(2).feet_size(), 0);
  ASSERT_EQ(encoded.feet_size(), 2);
  for (int i = 0; i < 2; ++i) {
    const v1::FootOnGround& foot = encoded.feet(i);
    EXPECT_EQ(foot.foot(), i == 0 ? v1::FOOT_RIGHT : v1::FOOT_LEFT);
    ASSERT_EQ(foot.contacts_size(), 1);
    EXPECT_EQ(foot.contacts(0), i == 0 ? "right_foot" : "left_foot");
    EXPECT_EQ(foot.stance_fraction(), events.feet[i].stance);
    EXPECT_EQ(foot.step_length_m(), i == 0 ? 0.75 : 0.65);
    EXPECT_EQ(foot.step_duration_s(), i == 0 ? 0.5 : 0.6);
    EXPECT_EQ(foot.loading_fraction(), i == 0 ? 0.05 : 0.06);
    ExpectInstants(foot.force_n(), events.feet[i].force);
    ExpectInstants(foot.level_force_n(), events.feet[i].level_force);
    ExpectInstants(foot.center_of_pressure_m(), events.feet[i].center_of_pressure);
  }
}

}  // namespace
}  // namespace rollgait::server
