#include "client/spec_flags.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "client/bound_flags.h"
#include "client/failure.h"
#include "client/spec_words.h"
#include "client/text.h"
#include "tests/client/parse_spec.h"

namespace rollgait::client {
namespace {

// Each has its word in the proto, and from there in the flag, its help and its completion.
TEST(SpecFlagsTest, EveryCostButTrackingHasAWord) {
  const google::protobuf::OneofDescriptor& terms = *v1::CostTerm::descriptor()->FindOneofByName("term");
  const std::vector<std::string> words = FlagWords("--cost");
  ASSERT_EQ(static_cast<int>(words.size()), terms.field_count() - 1) << "a word is missing, or two terms have the same";
  std::set<int> terms_of_words;
  for (const std::string& word : words) {
    EXPECT_THAT(CostWordList(), ::testing::HasSubstr(word));
    terms_of_words.insert(Parse("--cost " + word + ":2").costs(0).term_case());
  }
  EXPECT_EQ(terms_of_words.size(), words.size());
  EXPECT_EQ(terms_of_words.count(v1::CostTerm::kTracking), 0u) << "what it tracks, a file says";
  EXPECT_EQ(CostWordList().rfind("torque, ", 0), 0u);
}

TEST(SpecFlagsTest, NothingGivenIsTheEmptyRequest) {
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(Parse(""), v1::SolveSpec()));
}

TEST(SpecFlagsTest, EveryFlagReachesItsField) {
  const v1::SolveSpec spec = Parse(
      "--model planar --sex female --stature 1.7 --mass 61 --slope -10 --speed 1.2 --step-length 0.7 --step-duration "
      "0.6 "
      "--cycle full --friction 0.5 --clearance 0.02 --cost torque:2 --cost work:0.001 --cost torque-rate --cost time "
      "--normalize time --scheme hermite-simpson --intervals 32 --double-intervals 9 --accuracy fine --tolerance 1e-8 "
      "--max-refinements 2 --max-iterations 77 --time-limit 12.5 --duty-factor 0.61 --starts 4 "
      "--warm-start nearest --cost effort --cost muscle-work --cost passive-load "
      "--cost acceleration:1e-5 --cost force-rate:1e-7 --touch-down plastic --touch-down-point -0.9,-0.8 "
      "--lift-off-point 0.7 --allow-overlap --solver ipopt");
  EXPECT_EQ(spec.nlp_solver(), v1::NLP_SOLVER_IPOPT);
  EXPECT_TRUE(spec.limits().allow_body_overlap());
  EXPECT_EQ(spec.model().name(), "planar");
  EXPECT_EQ(spec.model().sex(), v1::ModelSelection::SEX_FEMALE);
  EXPECT_EQ(spec.model().stature_m(), 1.7);
  EXPECT_EQ(spec.model().body_mass_kg(), 61);
  EXPECT_NEAR(spec.slope_rad(), -M_PI / 18, 1e-15);
  EXPECT_EQ(spec.motion().speed_m_s(), 1.2);
  EXPECT_EQ(spec.motion().step_length_m(), 0.7);
  EXPECT_EQ(spec.motion().step_duration_s(), 0.6);
  EXPECT_EQ(spec.cycle(), v1::CYCLE_FULL);
  EXPECT_EQ(spec.ground_contact().friction_coefficient(), 0.5);
  EXPECT_EQ(spec.ground_contact().swing_clearance_m(), 0.02);
  EXPECT_EQ(spec.motion().duty_factor().min(), 0.61);
  EXPECT_EQ(spec.motion().duty_factor().max(), 0.61);
  EXPECT_EQ(spec.starts(), 4);
  EXPECT_EQ(spec.warm_start(), "nearest");
  EXPECT_EQ(spec.ground_contact().touch_down(), v1::TOUCH_DOWN_PLASTIC);
  EXPECT_EQ(spec.ground_contact().touch_down_point().min(), -0.9);
  EXPECT_EQ(spec.ground_contact().touch_down_point().max(), -0.8);
  EXPECT_EQ(spec.ground_contact().lift_off_point().min(), 0.7);
  EXPECT_EQ(spec.ground_contact().lift_off_point().max(), 0.7);
  ASSERT_EQ(spec.costs_size(), 9);
  EXPECT_TRUE(spec.costs(8).has_squared_force_rate());
  EXPECT_TRUE(spec.costs(4).has_muscle_effort());
  EXPECT_TRUE(spec.costs(5).has_muscle_work());
  EXPECT_TRUE(spec.costs(6).has_passive_load());
  EXPECT_TRUE(spec.costs(7).has_squared_acceleration());
  EXPECT_EQ(spec.costs(7).weight(), 1e-5);
  EXPECT_TRUE(spec.costs(0).has_squared_torque());
  EXPECT_EQ(spec.costs(0).weight(), 2);
  EXPECT_TRUE(spec.costs(1).has_mechanical_work());
  EXPECT_EQ(spec.costs(1).weight(), 0.001);
  EXPECT_TRUE(spec.costs(2).has_squared_torque_rate());
  EXPECT_FALSE(spec.costs(2).has_weight());
  EXPECT_TRUE(spec.costs(3).has_time());
  EXPECT_EQ(spec.cost_normalization(), v1::COST_NORMALIZATION_PER_TIME);
  EXPECT_EQ(spec.discretization().scheme(), v1::Discretization::SCHEME_HERMITE_SIMPSON);
  EXPECT_EQ(spec.discretization().single_support_intervals(), 32);
  EXPECT_EQ(spec.discretization().double_support_intervals(), 9);
  EXPECT_EQ(spec.accuracy().level(), v1::Accuracy::LEVEL_FINE);
  EXPECT_EQ(spec.accuracy().kkt_tolerance(), 1e-8);
  EXPECT_EQ(spec.accuracy().max_refinements(), 2);
  EXPECT_EQ(spec.solver_limits().max_iterations(), 77);
  EXPECT_EQ(spec.solver_limits().max_wall_time_s(), 12.5);
}

// What the server must refuse must reach it.
TEST(SpecFlagsTest, BodyFlagsReachTheirFields) {
  const v1::ModelSelection body = Parse(
                                      "--model human29 --segment thigh=0.45 --segment foot=0.3 --feet two --ranges "
                                      "walking --toes --sagittal --drop-arms --rigid-trunk "
                                      "--lock knee_l=20 --lock elbow_r=-1.5 --load hand_l=10 --load torso=5,0.1,-0.2,0 "
                                      "--strength hip_l=0.3 --spring ankle_l=340 --spring ankle_r=300,18,2 "
                                      "--foot heel_l=0.03,0.02,0.025:0.8 --foot forefoot=:1.2")
                                      .model();
  EXPECT_EQ(body.segment_lengths_m().at("thigh"), 0.45);
  EXPECT_EQ(body.segment_lengths_m().at("foot"), 0.3);
  EXPECT_EQ(body.feet(), v1::ModelSelection::FEET_TWO_ELLIPSOIDS);
  EXPECT_EQ(body.ranges(), v1::ModelSelection::RANGES_WALKING);
  EXPECT_TRUE(body.toes() && body.sagittal() && body.drop_arms() && body.rigid_trunk());
  EXPECT_NEAR(body.locked_joints_rad().at("knee_l"), M_PI / 9, 1e-15);
  EXPECT_NEAR(body.locked_joints_rad().at("elbow_r"), -M_PI / 120, 1e-15);
  ASSERT_EQ(body.loads_size(), 2);
  EXPECT_EQ(body.loads(0).segment(), "hand_l");
  EXPECT_EQ(body.loads(0).mass_kg(), 10);
  EXPECT_FALSE(body.loads(0).has_position_m());
  EXPECT_EQ(body.loads(1).position_m().x(), 0.1);
  EXPECT_EQ(body.loads(1).position_m().y(), -0.2);
  EXPECT_EQ(body.joint_strengths().at("hip_l"), 0.3);
  EXPECT_EQ(body.foot_semi_axes_m().at("heel_l").x(), 0.03);
  EXPECT_EQ(body.foot_semi_axes_m().at("heel_l").z(), 0.025);
  EXPECT_EQ(body.foot_semi_axes_m().size(), 1u);
  EXPECT_EQ(body.foot_exponents().at("heel_l"), 0.8);
  EXPECT_EQ(body.foot_exponents().at("forefoot"), 1.2);
  EXPECT_EQ(body.joint_springs().at("ankle_l").stiffness_n_m_rad(), 340);
  EXPECT_NEAR(body.joint_springs().at("ankle_r").rest_rad(), M_PI / 10, 1e-15);
  EXPECT_EQ(body.joint_springs().at("ankle_r").damping_n_m_s_rad(), 2);
  EXPECT_FALSE(Parse("--drop-arms").model().toes());
  for (const char* line :
       {"--lock knee_l", "--lock =3", "--lock knee_l=x", "--lock knee_l=3deg", "--segment thigh=", "--load hand_l",
        "--load hand_l=1,2", "--load =3", "--foot heel=1,2", "--foot heel",
        "--foot heel=0.03,0.02,0.025:", "--foot heel=:", "--foot =:1", "--foot heel:0.8", "--foot heel=1,2:0.8",
        "--foot heel=:0.8,1", "--strength hip_l", "--spring ankle_l=", "--spring ankle_l=1,2,3,4"}) {
    EXPECT_THROW(Parse(line), Failure) << line;
  }
}

TEST(SpecFlagsTest, ManoeuvreFlagsReachTheirFields) {
  const v1::SolveSpec spec =
      Parse("--model ball --from 0.5,-1 --to -2,3,0,0,90 --duration 1.5 --mass 2 --semi-axes 0.3,0.2,0.1");
  EXPECT_EQ(spec.manoeuvre().start().x_m(), 0.5);
  EXPECT_EQ(spec.manoeuvre().start().y_m(), -1);
  EXPECT_FALSE(spec.manoeuvre().start().has_orientation());
  const v1::Manoeuvre::State& end = spec.manoeuvre().end();
  EXPECT_EQ(end.x_m(), -2);
  EXPECT_EQ(end.y_m(), 3);
  EXPECT_NEAR(end.orientation().w(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(end.orientation().z(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(end.orientation().x(), 0);
  EXPECT_EQ(spec.manoeuvre().duration_s(), 1.5);
  EXPECT_EQ(spec.model().rolling_body().mass_kg(), 2);
  EXPECT_FALSE(spec.model().has_body_mass_kg());
  EXPECT_EQ(spec.model().rolling_body().semi_axes_m().x(), 0.3);
  EXPECT_EQ(spec.model().rolling_body().semi_axes_m().z(), 0.1);
  EXPECT_EQ(Parse("--to 1,2,0,0,0").manoeuvre().end().orientation().w(), 1);
  for (const char* const line : {"--to 1", "--to 1,2,", "--to 1,2,3", "--to a,b", "--from 1,2x", "--semi-axes 1,2"}) {
    EXPECT_THROW(Parse(line), Failure) << line;
  }
}

TEST(SpecFlagsTest, OutOfRangeNumbersArePassedOn) {
  EXPECT_TRUE(std::isnan(Parse("--speed nan").motion().speed_m_s()));
  EXPECT_NEAR(Parse("--slope 80").slope_rad(), 80 * M_PI / 180, 1e-15);
  EXPECT_EQ(Parse("--intervals 0").discretization().single_support_intervals(), 0);
  EXPECT_EQ(Parse("--cost torque:-1").costs(0).weight(), -1);
}

TEST(SpecFlagsTest, UnknownWordsAreRefusedWithTheKnownOnes) {
  for (const std::string line : {"--cost pain", "--cost torque:much", "--cost work:", "--scheme euler", "--cycle third",
                                 "--accuracy best", "--normalize mass", "--preset robot", "--sex other"}) {
    EXPECT_THROW(Parse(line), Failure) << line;
  }
  try {
    Parse("--cycle third");
    FAIL() << "was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_STREQ(failure.what(), "--cycle third: must be one of full, half");
  }
}

TEST(SpecFlagsTest, BoundsReachTheirFields) {
  const std::vector<std::string> names = BoundNames();
  EXPECT_EQ(names.size(), 15u);
  for (const std::string& name : names) {
    const v1::Accuracy accuracy = Parse("--bound " + name + "=0.0125").accuracy();
    const google::protobuf::FieldDescriptor* field = v1::Accuracy::descriptor()->FindFieldByName(name);
    ASSERT_NE(field, nullptr) << name;
    EXPECT_EQ(v1::Accuracy::GetReflection()->GetDouble(accuracy, field), 0.0125) << name;
  }
  const v1::Accuracy two = Parse("--bound max_gap_m=1e-6 --accuracy draft --bound max_pull_bw=1e-4").accuracy();
  EXPECT_EQ(two.max_gap_m(), 1e-6);
  EXPECT_EQ(two.max_pull_bw(), 1e-4);
  EXPECT_EQ(two.level(), v1::Accuracy::LEVEL_DRAFT);
  EXPECT_FALSE(two.has_max_slip_m_s());
  for (const char* const line : {"--bound max_gap_m", "--bound max_gap_m=", "--bound =1", "--bound max_gap_m=1x",
                                 "--bound kkt_tolerance=1", "--bound max_refinements=1"}) {
    EXPECT_THROW(Parse(line), Failure) << line;
  }
  try {
    Parse("--bound max_noise=1");
    FAIL() << "was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    for (const std::string& name : names) EXPECT_NE(std::string(failure.what()).find(name), std::string::npos) << name;
  }
}

TEST(SpecFlagsTest, ErrorsReachTheirFieldsInTheirUnits) {
  EXPECT_FALSE(Parse("--slope 1").accuracy().estimate_errors());
  EXPECT_TRUE(Parse("--errors").accuracy().estimate_errors());
  const v1::MaxError error =
      Parse("--max-error angle=0.5 --max-error torque=2 --max-error contact-force=9 --max-error objective=0.01")
          .accuracy()
          .max_error();
  EXPECT_NEAR(error.angle_rad(), 0.5 * kPi / 180, 1e-15);
  EXPECT_EQ(error.torque_n_m(), 2);
  EXPECT_EQ(error.contact_force_n(), 9);
  EXPECT_EQ(error.objective(), 0.01);
  EXPECT_FALSE(Parse("--max-error angle=1").accuracy().max_error().has_torque_n_m());
  EXPECT_THROW(Parse("--max-error speed=1"), Failure);
  EXPECT_THROW(Parse("--max-error angle"), Failure);
}

TEST(SpecFlagsTest, AWeightAfterAnEqualsSignIsToldWhereToStand) {
  try {
    Parse("--cost torque-rate=1e-4");
    FAIL() << "was accepted";
  } catch (const Failure& failure) {
    EXPECT_STREQ(failure.what(), "--cost torque-rate=1e-4: the weight stands after a colon, for example work:0.5");
  }
}

class SpecFileTest : public testing::Test {
 protected:
  std::string Write(const std::string& text) const {
    const std::string path = testing::TempDir() + "spec_flags_test.json";
    std::ofstream(path) << text;
    return path;
  }
};

TEST_F(SpecFileTest, FlagsOverrideTheFile) {
  const std::string file = Write(R"({"model": {"name": "planar", "sex": "SEX_FEMALE"}, "slope_rad": 0.1,
      "motion": {"freeSpeed": true, "stepLengthM": 0.6}, "costs": [{"time": {}}, {"time": {}}]})");
  const v1::SolveSpec plain = Parse("--spec " + file);
  EXPECT_EQ(plain.slope_rad(), 0.1);
  EXPECT_TRUE(plain.motion().free_speed());
  EXPECT_EQ(plain.costs_size(), 2);
  const v1::SolveSpec changed = Parse("--spec " + file + " --slope 0 --speed 1.1 --cost torque");
  EXPECT_EQ(changed.slope_rad(), 0);
  EXPECT_EQ(changed.model().sex(), v1::ModelSelection::SEX_FEMALE);
  EXPECT_FALSE(changed.motion().free_speed());
  EXPECT_EQ(changed.motion().step_length_m(), 0.6);
  ASSERT_EQ(changed.costs_size(), 3) << "a cost is added to those of the file";
  EXPECT_TRUE(changed.costs(2).has_squared_torque());
  try {
    Parse("--spec " + file + " --cost time:2");
    ADD_FAILURE() << "taken";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), testing::HasSubstr("--cost time:2: the file has two terms of this kind"));
  }
}

// Name by name: what the command line names is replaced as a whole, the rest of the file stays.
TEST_F(SpecFileTest, RepeatedFlagsAreLaidOverTheFileNameByName) {
  const std::string file = Write(R"({"model": {"name": "human29",
      "loads": [{"segment": "hand_l", "massKg": 3}, {"segment": "torso", "massKg": 5}, {"segment": "hand_l", "massKg": 1}],
      "jointSprings": {"ankle_l": {"stiffnessNMRad": 300, "restRad": 0.1, "dampingNMSRad": 2},
                       "knee_l": {"stiffnessNMRad": 50}},
      "jointStrengths": {"hip_l": 0.5}, "lockedJointsRad": {"elbow_l": 1}, "segmentLengthsM": {"thigh": 0.45}},
      "costs": [{"weight": 3, "muscleEffort": {"exponent": 4}}], "accuracy": {"maxPullBw": 0.5}})");
  const v1::SolveSpec spec =
      Parse("--spec " + file +
            " --load hand_l=10 --spring ankle_l=340 --spring ankle_r=200 --strength hip_r=0.4 "
            "--lock elbow_r=0 --segment shank=0.4 --cost effort:2 --cost time --bound max_slip_m_s=1");
  const v1::ModelSelection& body = spec.model();
  ASSERT_EQ(body.loads_size(), 2);
  EXPECT_EQ(body.loads(0).segment(), "torso");
  EXPECT_EQ(body.loads(1).mass_kg(), 10);
  EXPECT_EQ(body.joint_springs_size(), 3);
  EXPECT_EQ(body.joint_springs().at("ankle_l").stiffness_n_m_rad(), 340);
  EXPECT_EQ(body.joint_springs().at("ankle_l").rest_rad(), 0);
  EXPECT_EQ(body.joint_springs().at("ankle_l").damping_n_m_s_rad(), 0);
  EXPECT_EQ(body.joint_springs().at("knee_l").stiffness_n_m_rad(), 50);
  EXPECT_EQ(body.joint_strengths_size(), 2);
  EXPECT_EQ(body.locked_joints_rad_size(), 2);
  EXPECT_EQ(body.segment_lengths_m_size(), 2);
  ASSERT_EQ(spec.costs_size(), 2);
  EXPECT_EQ(spec.costs(0).weight(), 2) << "its term has another weight";
  EXPECT_EQ(spec.costs(0).muscle_effort().exponent(), 4);
  EXPECT_TRUE(spec.costs(1).has_time());
  EXPECT_EQ(spec.accuracy().max_pull_bw(), 0.5);
}

TEST_F(SpecFileTest, RefusesWhatIsNotARequest) {
  EXPECT_THROW(Parse("--spec " + Write("{\"sloperad\": 1}")), Failure);
  EXPECT_THROW(Parse("--spec " + Write("not json")), Failure);
  EXPECT_THROW(Parse("--spec no_such_file.json"), Failure);
}

TEST(SpecFlagsTest, AnErrorQuotesTheValueAsItWasWritten) {
  try {
    Parse("--spring ankle_l=stiff");
    ADD_FAILURE() << "taken";
  } catch (const Failure& failure) {
    EXPECT_STREQ(failure.what(), "--spring ankle_l=stiff: must be JOINT=STIFFNESS[,REST[,DAMPING]]");
  }
}

TEST(SpecFlagsTest, CostsJoinAPreset) {
  EXPECT_EQ(Parse("--preset human").preset(), v1::PRESET_HUMAN);
  EXPECT_EQ(Parse("--preset torque").preset(), v1::PRESET_TORQUE);
  EXPECT_EQ(Parse("--preset transport").preset(), v1::PRESET_TRANSPORT);
  const v1::SolveSpec both = Parse("--preset human --cost force-rate:1e-9");
  EXPECT_EQ(both.preset(), v1::PRESET_HUMAN);
  ASSERT_EQ(both.costs_size(), 1);
  EXPECT_TRUE(both.costs(0).has_squared_force_rate());
}

TEST_F(SpecFileTest, APresetReplacesTheCostsOfTheFileAndACostIsAdded) {
  const std::string file = Write(R"({"preset": "PRESET_HUMAN", "costs": [{"time": {}}]})");
  const v1::SolveSpec cost = Parse("--spec " + file + " --cost effort:2");
  EXPECT_EQ(cost.preset(), v1::PRESET_HUMAN);
  ASSERT_EQ(cost.costs_size(), 2);
  EXPECT_TRUE(cost.costs(1).has_muscle_effort());
  const v1::SolveSpec preset = Parse("--spec " + file + " --preset transport");
  EXPECT_EQ(preset.preset(), v1::PRESET_TRANSPORT);
  EXPECT_EQ(preset.costs_size(), 0);
}

}  // namespace
}  // namespace rollgait::client
