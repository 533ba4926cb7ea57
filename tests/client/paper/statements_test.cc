// Verdicts follow the figures: each turns when its figures do.
#include "client/paper/statements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

class StatementsTest : public testing::Test {
 protected:
  StatementsTest() {
    for (const double slope_rad : {0.1745, 0.0, -0.1745}) {
      solves_.push_back(SampleSolve("solves/a", slope_rad));
      figures_.push_back(MeasureSlope(solves_.back()));
    }
  }
  Statement Of(const std::string& words) const {
    for (const Statement& statement : CompareStatements(solves_, figures_)) {
      if (statement.paper.find(words) != std::string::npos) return statement;
    }
    ADD_FAILURE() << words;
    return {};
  }
  void Expect(const std::string& words, Agreement agreement) const {
    EXPECT_EQ(Of(words).agreement, agreement) << words << ": " << Of(words).ours << ", " << Of(words).why;
  }

  std::vector<v1::Solve> solves_;
  std::vector<SlopeFigures> figures_;
};

TEST_F(StatementsTest, DegreesOfFreedom) {
  Expect("29 degrees of freedom", Agreement::kDisagrees);
  solves_[0].mutable_result()->mutable_model()->mutable_summary()->set_degrees_of_freedom(29);
  solves_[0].mutable_result()->mutable_model()->mutable_summary()->set_actuated_joints(23);
  Expect("29 degrees of freedom", Agreement::kAgrees);
}

TEST_F(StatementsTest, CostOfTorqueAlone) {
  Expect("squared torque, weighted", Agreement::kAgrees);
  solves_[0].mutable_result()->add_costs()->set_name("mechanical work");
  Expect("squared torque, weighted", Agreement::kDisagrees);
}

TEST_F(StatementsTest, PhasesOfOneOrTwoFeet) {
  Expect("two kinds of phases", Agreement::kAgrees);
  figures_[1].phases[1].feet = 0;
  Expect("two kinds of phases", Agreement::kDisagrees);
}

TEST_F(StatementsTest, DurationsThatDiffer) {
  Expect("not the same", Agreement::kDisagrees);
  figures_[0].phases[0].end_percent += 1.5;
  Expect("not the same", Agreement::kAgrees);
  EXPECT_THAT(Of("not the same").why, HasSubstr("differ by 1.5 %"));
}

TEST_F(StatementsTest, HeelStrikes) {
  Expect("Heel strike", Agreement::kDisagrees);
  EXPECT_THAT(Of("Heel strike").why, HasSubstr("mirror images"));
  figures_[0].events.opposite_heel_strike = 56;
  figures_[1].events.opposite_heel_strike = 41;
  figures_[2].events.opposite_heel_strike = 54;
  Expect("Heel strike", Agreement::kAgrees);
  figures_[1].events.opposite_heel_strike.reset();
  Expect("Heel strike", Agreement::kDisagrees);
}

TEST_F(StatementsTest, EffortDownhill) {
  figures_[2].total.squared = 1.2 * figures_[0].total.squared;
  Expect("larger downhill", Agreement::kAgrees);
  EXPECT_THAT(Of("larger downhill").why, HasSubstr("1.2 in squared torque"));
  EXPECT_THAT(Of("larger downhill").why, HasSubstr("the two measures differ"));
  figures_[2].total.squared = 0.8 * figures_[0].total.squared;
  Expect("larger downhill", Agreement::kDisagrees);
  figures_[2].stride_length_m *= 0.5;  // it is the effort per metre that counts
  Expect("larger downhill", Agreement::kAgrees);
}

TEST_F(StatementsTest, BrakingDownhill) {
  for (SlopeFigures& figures : figures_) figures.total.positive_work = figures.total.negative_work + 10;
  Expect("slowing", Agreement::kDisagrees);
  figures_[2].total.negative_work += 30;
  Expect("slowing", Agreement::kAgrees);
}

TEST_F(StatementsTest, TorqueAxes) {
  Expect("between −100 and 100", Agreement::kAgrees);
  figures_[1].total.peak = 101;
  Expect("between −100 and 100", Agreement::kDisagrees);
}

TEST_F(StatementsTest, RollingPeriodicityTimeAndPoints) {
  Expect("without slipping", Agreement::kAgrees);
  solves_[1].mutable_result()->mutable_accuracy()->set_max_slip_m_s(0.02);
  Expect("without slipping", Agreement::kDisagrees);
  Expect("periodic", Agreement::kAgrees);
  solves_[2].mutable_result()->mutable_accuracy()->set_periodicity_error(1e-3);
  Expect("periodic", Agreement::kDisagrees);
  Expect("20 minutes", Agreement::kAgrees);
  figures_[0].wall_time_s = 1201;
  Expect("20 minutes", Agreement::kDisagrees);
  Expect("are imposed", Agreement::kDisagrees);
  auto* const point = solves_[0].mutable_spec()->mutable_ground_contact()->mutable_touch_down_point();
  point->set_min(-0.6);
  point->set_max(-0.6);
  Expect("are imposed", Agreement::kAgrees);
}

TEST_F(StatementsTest, MotionsOfTheirMeshDecideNothing) {
  figures_[2].total.squared = 1.2 * figures_[0].total.squared;
  solves_[0].mutable_result()->mutable_accuracy()->set_max_slip_m_s(0.3);  // of 1.3 m/s
  Expect("larger downhill", Agreement::kOpen);
  EXPECT_THAT(Of("larger downhill").why, HasSubstr("23 % of the speed"));
  Expect("without slipping", Agreement::kDisagrees);
  Expect("20 minutes", Agreement::kAgrees);
}

TEST_F(StatementsTest, AGaitThatWasNotFoundLeavesAllOpen) {
  figures_[2].solved = false;
  for (const Statement& statement : CompareStatements(solves_, figures_)) {
    EXPECT_EQ(statement.agreement, Agreement::kOpen) << statement.paper;
  }
  solves_[2].clear_result();
  figures_[2] = MeasureSlope(solves_[2]);  // nothing at all is known of it
  for (const Statement& statement : CompareStatements(solves_, figures_)) {
    EXPECT_EQ(statement.agreement, Agreement::kOpen) << statement.paper;
  }
}

}  // namespace
}  // namespace rollgait::client
