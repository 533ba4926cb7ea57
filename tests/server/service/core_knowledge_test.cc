#include "server/service/core_knowledge.h"

#include <gtest/gtest.h>

#include "tests/support/ball_joints.h"

namespace rollgait::server {
namespace {

TEST(CoreKnowledgeTest, EveryListedModelCanBeHadAndMoves) {
  const GaitKnowledge knowledge = MakeCoreKnowledge();
  const v1::ListModelsResponse models = knowledge.list_models();
  ASSERT_GT(models.models_size(), 0);
  for (const v1::ModelSummary& summary : models.models()) {
    v1::ModelSelection selection;
    selection.set_name(summary.name());
    const Result<v1::Model> model = knowledge.get_model(selection);
    ASSERT_TRUE(model.ok()) << summary.name();
    EXPECT_EQ(model.value().joints_size(), summary.degrees_of_freedom());
    EXPECT_EQ(model.value().contacts_size(), summary.contact_names_size());
    EXPECT_EQ(model.value().gravity_m_s2(), 9.81);
    v1::SolveSpec spec;
    *spec.mutable_model() = selection;
    if (summary.name() == "ball") {  // it does not walk, and goes where it is told
      EXPECT_FALSE(knowledge.check_spec(spec).ok());
      spec.mutable_manoeuvre()->set_duration_s(2);
      spec.mutable_manoeuvre()->mutable_end()->set_x_m(1);
      spec.mutable_manoeuvre()->mutable_end()->set_y_m(0);
    }
    EXPECT_TRUE(knowledge.check_spec(spec).ok()) << summary.name();
  }
}

TEST(CoreKnowledgeTest, BallsAreWrittenAsGivenOrAsTheirChains) {
  const GaitKnowledge knowledge = MakeCoreKnowledge();
  v1::ModelSelection selection;
  selection.set_name("human29");
  const v1::Model human = knowledge.get_model(selection).value();
  selection.Clear();
  *selection.mutable_own() = rollgait::testing::WithBalls(human, rollgait::testing::HumanBalls());
  const Result<v1::Model> balls = knowledge.get_model(selection);
  ASSERT_TRUE(balls.ok());
  EXPECT_EQ(balls.value().joints_size(), selection.own().joints_size());
  const v1::Model chains = knowledge.with_joint_chains(balls.value());
  ASSERT_EQ(chains.joints_size(), human.joints_size());
  for (int i = 0; i < human.joints_size(); ++i) {
    EXPECT_EQ(chains.joints(i).SerializeAsString(), human.joints(i).SerializeAsString()) << human.joints(i).name();
  }
}

TEST(CoreKnowledgeTest, RefusalsNameTheField) {
  const GaitKnowledge knowledge = MakeCoreKnowledge();
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("snake");
  ASSERT_FALSE(knowledge.check_spec(spec).ok());
  EXPECT_EQ(knowledge.check_spec(spec).violations()[0].field, "model.name");
  spec.mutable_model()->set_name(knowledge.list_models().models(0).name());
  spec.set_slope_rad(1);
  ASSERT_FALSE(knowledge.check_spec(spec).ok());
  EXPECT_EQ(knowledge.check_spec(spec).violations()[0].field, "slope_rad");
  v1::ModelSelection selection = spec.model();
  selection.set_stature_m(9);
  ASSERT_FALSE(knowledge.get_model(selection).ok());
  EXPECT_EQ(knowledge.get_model(selection).violations()[0].field, "stature_m");
}

}  // namespace
}  // namespace rollgait::server
