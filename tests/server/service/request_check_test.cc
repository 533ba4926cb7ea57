#include "server/service/request_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::server {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::set<std::string> Fields(const Violations& violations) {
  std::set<std::string> fields;
  for (const Violation& violation : violations) fields.insert(violation.field);
  return fields;
}

TEST(CheckWellFormedTest, AGoodRequestPasses) {
  v1::CreateSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->set_cycle(v1::CYCLE_FULL);
  (*request.mutable_spec()->mutable_limits()->mutable_joint_position())["knee"].set_min(-1e300);
  EXPECT_TRUE(CheckWellFormed(request, "").empty());
}

TEST(CheckWellFormedTest, FindsNumbersThatAreNotFiniteWhereverTheyAre) {
  v1::CreateSolveRequest request;
  v1::SolveSpec& spec = *request.mutable_spec();
  spec.set_slope_rad(kNan);
  spec.mutable_motion()->set_speed_m_s(kInf);
  spec.mutable_phases()->add_phases();
  spec.mutable_phases()->add_phases()->set_min_duration_s(-kInf);
  auto* channel = spec.add_costs()->mutable_tracking()->add_channels();
  channel->add_positions(0);
  channel->add_positions(kNan);
  (*spec.add_costs()->mutable_squared_torque()->mutable_joint_weights())["hip_l"] = kInf;
  (*spec.mutable_limits()->mutable_joint_position())["knee_r"].set_max(kNan);
  EXPECT_EQ(Fields(CheckWellFormed(request, "")),
            (std::set<std::string>{"spec.slope_rad", "spec.motion.speed_m_s", "spec.phases.phases[1].min_duration_s",
                                   "spec.costs[0].tracking.channels[0].positions[1]",
                                   "spec.costs[1].squared_torque.joint_weights[\"hip_l\"]",
                                   "spec.limits.joint_position[\"knee_r\"].max"}));
}

TEST(CheckWellFormedTest, FindsUnknownEnumValuesAndFields) {
  v1::SolveSpec spec;
  spec.set_cycle(static_cast<v1::Cycle>(17));
  spec.mutable_accuracy()->set_level(static_cast<v1::Accuracy::Level>(-3));
  spec.mutable_motion()->GetReflection()->MutableUnknownFields(spec.mutable_motion())->AddVarint(99, 1);
  const Violations violations = CheckWellFormed(spec, "spec.");
  EXPECT_EQ(Fields(violations), (std::set<std::string>{"spec.cycle", "spec.accuracy.level", "spec.motion.99"}));
  for (const Violation& violation : violations) EXPECT_FALSE(violation.message.empty());
}

// Two million empty messages fit into the bytes of a request.
TEST(CheckWellFormedTest, RefusesMoreMessagesThanAnyRequestNeeds) {
  v1::CreateSolveRequest request;
  v1::ModelSelection& model = *request.mutable_spec()->mutable_model();
  for (int i = 0; i < 99'000; ++i) model.add_loads();
  EXPECT_TRUE(CheckWellFormed(request, "").empty());
  for (int i = 0; i < 1'000; ++i) model.add_loads();
  EXPECT_EQ(Fields(CheckWellFormed(request, "")), std::set<std::string>{"spec.model.loads"});
  // Many in no single field.
  v1::CreateSolveRequest costs;
  for (int i = 0; i < 400; ++i) {
    auto& tracking = *costs.mutable_spec()->add_costs()->mutable_tracking();
    for (int k = 0; k < 300; ++k) tracking.add_channels();
  }
  const Violations violations = CheckWellFormed(costs, "");
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].field.rfind("spec.costs[", 0), 0u) << violations[0].field;
  // Entries of maps.
  v1::CreateSolveRequest map;
  for (int i = 0; i < 100'001; ++i) (*map.mutable_labels())[std::to_string(i)];
  for (int i = 0; i < 100'001; ++i)
    (*map.mutable_spec()->mutable_model()->mutable_joint_strengths())[std::to_string(i)];
  EXPECT_EQ(CheckWellFormed(map, "").size(), 1u);
}

TEST(CheckWellFormedTest, TellsTheFirstHundredOfWhatIsWrong) {
  v1::CreateSolveRequest request;
  auto* channel = request.mutable_spec()->add_costs()->mutable_tracking()->add_channels();
  for (int i = 0; i < 1000; ++i) channel->add_positions(kNan);
  EXPECT_EQ(CheckWellFormed(request, "").size(), 100u);
}

TEST(CheckSizeTest, RefusesWhatIsTooLargeAndNamesTheLargestField) {
  v1::CreateSolveRequest request;
  request.set_request_id("small");
  request.mutable_spec()->mutable_model()->set_name(std::string(kMaxRequestBytes - 100, 'x'));
  EXPECT_TRUE(CheckSize(request).empty());
  request.mutable_spec()->mutable_model()->set_name(std::string(kMaxRequestBytes, 'x'));
  const Violations violations = CheckSize(request);
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].field, "spec");
  EXPECT_NE(violations[0].message.find(std::to_string(kMaxRequestBytes)), std::string::npos);
}

TEST(CheckRequestIdTest, AtMost128PrintableCharacters) {
  EXPECT_TRUE(CheckRequestId("").empty());
  EXPECT_TRUE(CheckRequestId(std::string(128, '~')).empty());
  EXPECT_EQ(CheckRequestId(std::string(129, 'a')).size(), 1u);
  EXPECT_EQ(CheckRequestId("line\n").size(), 1u);
  EXPECT_EQ(CheckRequestId("gr\xc3\xbc").size(), 1u);
}

TEST(InvalidArgumentTest, TheMessageHoldsTheFirstViolation) {
  const Error error = InvalidArgument({{"a.b", "is 7, the limit is 3"}, {"c", "x"}});
  EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(error.message, "a.b is 7, the limit is 3 (and 1 more)");
}

}  // namespace
}  // namespace rollgait::server
