// Subjects whose sides differ: loads against sums over two bodies, mirrored subjects, what is refused.
#include "core/models/subject_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/models/catalog.h"
#include "core/multibody/body_dynamics.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

BodyRequest Human() {
  BodyRequest request;
  request.model = "human29";
  return request;
}

Scene Built(const BodyRequest& request) { return BuildScene(request).value(); }

// Every link with its own velocity.
BodyDynamics::State Moving(const BodyDynamics& dynamics) {
  std::mt19937 random(5);
  BodyDynamics::State state;
  const VectorX q = testing::RandomVector(random, dynamics.nq(), 0.3);
  dynamics.ComputeState(q, testing::RandomVector(random, dynamics.nv(), 2), &state);
  return state;
}

// Kinetic energy and momentum of a load are those of a body on the forearm, beyond those of the human without it.
TEST(SubjectLoad, IsABodyOnItsLink) {
  BodyRequest request = Human();
  const Scene bare = Built(request);
  const double mass = 10;
  const Vector3 isb(0.05, -0.1, 0.03), moments(0.2, 0.1, 0.15);
  request.changes.loads = {{.segment = "hand_l", .mass = mass, .position = isb, .moments = moments}};
  const Scene loaded = Built(request);
  EXPECT_NEAR(loaded.model.total_mass(), bare.model.total_mass() + mass, 1e-12 * 85);
  EXPECT_FALSE(loaded.symmetric);

  const BodyDynamics without(bare.model), with(loaded.model);
  const BodyDynamics::State state = Moving(without);
  const SegmentTable table(Sex::kMale, bare.selection.stature, bare.selection.mass);
  // From the elbow: the wrist below it, then X forward, Y up, Z right.
  const Vector3 place(isb.x(), -isb.z(), isb.y() - table.Length(Segment::kForearm));
  const BodyDynamics::Link& forearm = state[static_cast<size_t>(bare.model.Find("elbow_l"))];
  const Vector3 velocity = forearm.twist.linear + forearm.twist.angular.cross(place);
  const Vector3 inertia(moments.x(), moments.z(), moments.y());
  const double energy = 0.5 * mass * velocity.squaredNorm() + 0.5 * inertia.dot(forearm.twist.angular.cwiseAbs2());
  ASSERT_GT(energy, 1);
  EXPECT_NEAR(with.KineticEnergy(state), without.KineticEnergy(state) + energy, 1e-12 * without.KineticEnergy(state));
  const Vector3 momentum = mass * forearm.R_WL * velocity;
  EXPECT_LT((with.LinearMomentum(state) - without.LinearMomentum(state) - momentum).norm(), 1e-11 * momentum.norm());
}

TEST(SubjectLoad, LiesAtTheCentreOfItsSegmentByDefault) {
  BodyRequest request = Human();
  const Scene bare = Built(request);
  for (const char* segment : {"thigh_r", "foot_l", "head_neck", "pelvis", "torso", "upper_arm_r", "shank_l"}) {
    request.changes.loads = {{.segment = segment, .mass = 2, .position = {}}};
    const Scene loaded = Built(request);
    int changed = 0;
    for (int i = 0; i < bare.model.size(); ++i) {
      const Joint &joint = loaded.model.joint(i), &before = bare.model.joint(i);
      if (joint.mass == before.mass) continue;
      ++changed;
      EXPECT_NEAR(joint.mass, before.mass + 2, 1e-12) << segment;
      // Torso and head are one link; of the others the centre stays.
      if (std::string(segment) == "head_neck" || std::string(segment) == "torso") continue;
      EXPECT_LT((joint.center_of_mass - before.center_of_mass).norm(), 1e-12) << segment;
    }
    EXPECT_EQ(changed, 1) << segment;
  }
}

// What is alike on both sides leaves the body its mirror image.
TEST(Subject, IsSymmetricWhereBothSidesAreChangedAlike) {
  BodyRequest request = Human();
  request.segment_lengths = {{"thigh_l", 0.41}, {"thigh_r", 0.41}};
  request.changes.strengths = {{"knee_l", 0.5}, {"knee_r", 0.5}};
  request.changes.springs = {{"ankle_l", {300, 0.1, 2}}, {"ankle_r", {300, 0.1, 2}}};
  request.changes.loads = {{.segment = "hand_l", .mass = 3, .position = Vector3(0.1, -0.1, 0.02)},
                           {.segment = "hand_r", .mass = 3, .position = Vector3(0.1, -0.1, -0.02)},
                           {.segment = "torso", .mass = 12, .position = Vector3(-0.2, -0.2, 0)}};
  EXPECT_TRUE(Built(request).symmetric);
  const Scene both = Built(request);
  EXPECT_EQ(both.model.joint(both.model.Find("knee_l")).mirror_joint, both.model.Find("knee_r"));
  const auto differs = [&](void (*change)(BodyRequest * request)) {
    BodyRequest other = request;
    change(&other);
    const Scene scene = Built(other);
    for (int i = 0; i < scene.model.size(); ++i) {
      if (!scene.symmetric && (scene.model.joint(i).mirror_joint != i || scene.model.joint(i).mirror_sign != 1)) {
        return false;
      }
    }
    return !scene.symmetric;
  };
  EXPECT_TRUE(differs([](BodyRequest* r) { r->segment_lengths["thigh_l"] = 0.42; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->segment_lengths["foot_r"] = 0.25; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.strengths["knee_l"] = 0.4; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.strengths["ankle_l"] = 0; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.springs["ankle_l"].stiffness = 301; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.springs["ankle_l"].rest = 0.2; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.springs["ankle_l"].damping = 3; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.loads[0].mass = 4; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.loads[0].position->z() = -0.02; }));
  EXPECT_TRUE(differs([](BodyRequest* r) { r->changes.loads[2].position->z() = 0.01; }));
}

// The left one is the right one, mirrored: the joint of each side with the other's numbers.
TEST(Subject, OfOneSideIsTheMirrorImageOfThatOfTheOther) {
  BodyRequest left = Human(), right = Human();
  const auto change = [](const std::string& side, double outwards, BodyRequest* request) {
    request->segment_lengths = {{"thigh" + side, 0.40}, {"foot" + side, 0.25}, {"forearm" + side, 0.25}};
    request->changes.strengths = {{"knee" + side, 0.5}, {"ankle" + side, 0}};
    request->changes.springs = {{"ankle" + side, {300, 0.1, 2}}};
    request->changes.loads = {
        {.segment = "hand" + side, .mass = 3, .position = Vector3(0.1, -0.1, 0.02 * outwards), .moments = {1, 1, 1}}};
  };
  change("_l", -1, &left);
  change("_r", 1, &right);
  const Scene a = Built(left), b = Built(right), bare = Built(Human());
  const Matrix3 flip = Vector3(1, -1, 1).asDiagonal();
  for (int i = 0; i < a.model.size(); ++i) {
    const Joint& joint = a.model.joint(i);
    const Joint& image = b.model.joint(bare.model.joint(i).mirror_joint);
    EXPECT_NEAR(joint.mass, image.mass, 1e-12) << joint.name;
    EXPECT_LT((joint.p_PJ - flip * image.p_PJ).norm(), 1e-12) << joint.name;
    EXPECT_LT((joint.center_of_mass - flip * image.center_of_mass).norm(), 1e-12) << joint.name;
    EXPECT_LT((joint.inertia - flip * image.inertia * flip).norm(), 1e-12) << joint.name;
    EXPECT_EQ(joint.effort_max, image.effort_max) << joint.name;
    EXPECT_EQ(joint.actuated, image.actuated) << joint.name;
    EXPECT_EQ(joint.stiffness, image.stiffness) << joint.name;
  }
  EXPECT_EQ(a.leg_length, b.leg_length);
  for (size_t c = 0; c < a.contacts.size(); ++c) {
    const ContactSurface &mine = a.contacts[c], &other = b.contacts[static_cast<size_t>(mine.mirror_contact)];
    EXPECT_EQ(mine.surface.ellipsoid()->semi_axes(), other.surface.ellipsoid()->semi_axes());
    EXPECT_LT((mine.p_LE - flip * other.p_LE).norm(), 1e-12);
  }
}

TEST(Subject, HasTheLengthOfTheLongerLegAndOfEachSide) {
  BodyRequest request = Human();
  const Scene bare = Built(request);
  const double thigh = SegmentTable(Sex::kMale, bare.selection.stature, bare.selection.mass).Length(Segment::kThigh);
  request.segment_lengths = {{"thigh_l", thigh - 0.03}};
  const Scene shorter = Built(request);
  EXPECT_EQ(shorter.leg_length, bare.leg_length);
  const auto knee = [](const Scene& scene, const char* name) {
    return -scene.model.joint(scene.model.Find(name)).p_PJ.z();
  };
  EXPECT_NEAR(knee(shorter, "knee_l"), thigh - 0.03, 1e-15);
  EXPECT_EQ(knee(shorter, "knee_r"), thigh);
  // One side wins over both.
  request.segment_lengths = {{"thigh", 0.45}, {"thigh_r", 0.44}};
  EXPECT_NEAR(knee(Built(request), "knee_l"), 0.45, 1e-15);
  EXPECT_NEAR(knee(Built(request), "knee_r"), 0.44, 1e-15);
}

TEST(Subject, WithoutStrengthHasNoMuscles) {
  BodyRequest request = Human();
  request.changes.strengths = {{"ankle_l", 0}, {"knee_l", 0.25}};
  const Scene weak = Built(request), bare = Built(Human());
  const Joint& ankle = weak.model.joint(weak.model.Find("ankle_l"));
  EXPECT_FALSE(ankle.actuated);
  EXPECT_EQ(ankle.passive, PassiveKind::kNone);
  EXPECT_EQ(weak.model.actuated().size(), bare.model.actuated().size() - 1);
  const int knee = weak.model.Find("knee_l");
  EXPECT_EQ(weak.model.joint(knee).effort_max, 0.25 * bare.model.joint(knee).effort_max);
  EXPECT_EQ(weak.model.joint(knee).effort_min, 0.25 * bare.model.joint(knee).effort_min);
}

TEST(Subject, NamesWhatIsRefused) {
  BodyRequest request = Human();
  request.segment_lengths = {{"torso_l", 0.5}, {"thigh_l", 0.1}};
  request.locked_joints = {{"knee_l", 0.1}};
  request.changes.loads = {{.segment = "hand", .mass = 101, .position = Vector3(0, 2, 0), .moments = {1, 1, 3}}};
  request.changes.strengths = {{"knee_l", 0.5}, {"hip_l", 1.5}, {"base_x", 0.5}, {"nose", 0.5}};
  request.changes.springs = {{"ankle_l", {-1, 4, 2e4}}};
  const Result<Scene> scene = BuildScene(request);
  ASSERT_FALSE(scene.ok());
  std::map<std::string, std::string> said;
  for (const Violation& violation : scene.violations()) said[violation.field] = violation.message;
  EXPECT_THAT(said["segment_lengths_m[\"torso_l\"]"], HasSubstr("thigh"));
  EXPECT_THAT(said["segment_lengths_m[\"thigh_l\"]"], HasSubstr("is 0.1 m; must be between"));
  EXPECT_THAT(said["loads[0].segment"], HasSubstr("hand_l"));
  EXPECT_THAT(said["loads[0].mass_kg"], HasSubstr("is 101 kg; must be more than 0 and at most 100 kg"));
  EXPECT_THAT(said["loads[0].position_m"], HasSubstr("between -1 and 1 m"));
  EXPECT_THAT(said["loads[0].moments_kg_m2"], HasSubstr("the sum of any two"));
  EXPECT_THAT(said["joint_strengths[\"knee_l\"]"], HasSubstr("fixed"));
  EXPECT_THAT(said["joint_strengths[\"hip_l\"]"], HasSubstr("is 1.5; must be between 0 and 1"));
  EXPECT_THAT(said["joint_strengths[\"base_x\"]"], HasSubstr("floating base"));
  EXPECT_THAT(said["joint_strengths[\"base_x\"]"], HasSubstr("choose from hip_l, "));
  EXPECT_THAT(said["joint_strengths[\"base_x\"]"], Not(HasSubstr("knee_l"))) << "it is locked";
  EXPECT_THAT(said["joint_strengths[\"nose\"]"], HasSubstr("no joint"));
  EXPECT_THAT(said["joint_springs[\"ankle_l\"].stiffness_n_m_rad"],
              HasSubstr("is -1 N m/rad (-0.0174533 N m/deg); must be between 0"));
  EXPECT_THAT(said["joint_springs[\"ankle_l\"].rest_rad"],
              HasSubstr("is 4 rad (229.183 deg); must be between -3.14159 and 3.14159 rad (-180 and 180 deg)"));
  EXPECT_THAT(said["joint_springs[\"ankle_l\"].damping_n_m_s_rad"], HasSubstr("20000"));
  EXPECT_EQ(said.size(), 13u);

  request = Human();
  const Scene bare = Built(request);
  for (const Joint& joint : bare.model.joints()) {
    if (joint.actuated) request.changes.strengths[joint.name] = 0;
  }
  EXPECT_EQ(BuildScene(request).violations().front().field, "joint_strengths");
  request = Human();
  request.changes.loads.assign(17, {.segment = "hand_l", .mass = 1, .position = {}});
  EXPECT_EQ(BuildScene(request).violations().front().field, "loads");
  request = Human();
  request.model = "ball";
  request.changes.loads.assign(1, {.segment = "hand_l", .mass = 1, .position = {}});
  EXPECT_EQ(BuildScene(request).violations().front().field, "loads");
}

// One cause, one message: a mass that is out of range does not bound the moments, too.
TEST(Subject, IsRefusedOnceForOneMass) {
  BodyRequest request = Human();
  request.changes.loads = {{.segment = "hand_l", .mass = -1, .position = {}}};
  const Result<Scene> scene = BuildScene(request);
  ASSERT_EQ(scene.violations().size(), 1u);
  EXPECT_EQ(scene.violations()[0].field, "loads[0].mass_kg");
}

TEST(Subject, IsToldTheNameThatMayHaveBeenMeant) {
  BodyRequest request = Human();
  request.segment_lengths = {{"thihg_l", 0.4}};
  request.locked_joints = {{"knee_lft", 0.1}};
  request.changes.loads = {{.segment = "hand", .mass = 1, .position = {}},
                           {.segment = "torsoo", .mass = 1, .position = {}}};
  request.changes.springs = {{"ankel_l", {300, 0, 0}}};
  const Violations violations = BuildScene(request).violations();
  std::map<std::string, std::string> said;
  for (const Violation& violation : violations) said[violation.field] = violation.message;
  EXPECT_THAT(said["segment_lengths_m[\"thihg_l\"]"], HasSubstr("did you mean thigh_l?"));
  EXPECT_THAT(said["locked_joints_rad[\"knee_lft\"]"], HasSubstr("did you mean knee_l?"));
  EXPECT_EQ(said["loads[0].segment"], "\"hand\" is on both sides; choose hand_l or hand_r");
  EXPECT_THAT(said["loads[1].segment"], HasSubstr("did you mean torso?"));
  EXPECT_THAT(said["joint_springs[\"ankel_l\"]"], HasSubstr("did you mean ankle_l?"));
  EXPECT_EQ(violations.size(), 5u);
}

// Its sources do not say of a body whose sides differ that one mirrors the other.
TEST(Subject, HasSourcesThatAreTrueOfIt) {
  const auto says = [](const Scene& scene, const std::string& words) {
    return std::any_of(scene.sources.begin(), scene.sources.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
  };
  BodyRequest request = Human();
  EXPECT_TRUE(says(Built(request), "Left segments mirror the right ones;"));
  request.changes.springs = {{"ankle_l", {300, 0, 0}}};
  EXPECT_FALSE(says(Built(request), "Left segments mirror the right ones;"));
  EXPECT_TRUE(says(Built(request), "left and right of this body differ"));
}

}  // namespace
}  // namespace rollgait
