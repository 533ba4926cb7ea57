// What averaging reports does not depend on which of a pair comes first.
#include "client/import/mirror_average.h"

#include <gtest/gtest.h>

#include <utility>

namespace rollgait::client {
namespace {

// Two links of a pair, with these masses and as many kg m² about each axis.
v1::Model Pair(double first, double second) {
  v1::Model model;
  for (const double mass : {first, second}) {
    v1::Joint& joint = *model.add_joints();
    joint.set_parent(-1);
    joint.set_type(v1::Joint::TYPE_REVOLUTE);
    joint.mutable_axis()->set_y(1);
    joint.set_mass_kg(mass);
    for (const double entry : {mass, mass, mass, 0.0, 0.0, 0.0}) joint.add_inertia_kg_m2(entry);
    joint.set_mirror_joint(2 - model.joints_size());
    joint.set_mirror_sign(1);
  }
  return model;
}

TEST(MirrorAverageTest, TheChangeIsThatOfTheLighterLink) {
  for (const auto& [first, second] : {std::pair(1.0, 3.0), std::pair(3.0, 1.0)}) {
    v1::Model model = Pair(first, second);
    const MirrorChange change = AverageMirrorImages(&model);
    EXPECT_DOUBLE_EQ(model.joints(0).mass_kg(), 2);
    EXPECT_DOUBLE_EQ(change.mass, 1) << first;
    EXPECT_DOUBLE_EQ(change.inertia, 1) << first;
  }
}

}  // namespace
}  // namespace rollgait::client
