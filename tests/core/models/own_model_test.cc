// A walker as data: what a built-in scene says comes back to the bit, and what is wrong is named.
#include "core/models/own_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <utility>

#include "core/models/catalog.h"

namespace rollgait {
namespace {

using ::testing::HasSubstr;

Scene BuiltIn(const char* name, FootShape feet) {
  BodyRequest request;
  request.model = name;
  request.feet = feet;
  return BuildScene(request).value();
}

OwnModel DataOf(const Scene& scene) {
  return {scene.name, scene.description, scene.model.joints(), scene.contacts, scene.bodies, scene.pairs,
          {},         scene.leg_length,  scene.sources};
}

OwnModel Human() { return DataOf(BuiltIn("human29", FootShape::kTwoEllipsoids)); }

class ReadBackTest : public ::testing::TestWithParam<std::pair<const char*, FootShape>> {};

TEST_P(ReadBackTest, IsTheSameToTheBit) {
  const Scene scene = BuiltIn(GetParam().first, GetParam().second);
  OwnModel data = DataOf(scene);
  for (BodyPair& pair : data.pairs) pair.mirror_pair = -1;
  const Result<Scene> result = OwnScene(data);
  ASSERT_TRUE(result.ok()) << result.violations()[0].field << " " << result.violations()[0].message;
  const Scene& back = result.value();
  ASSERT_EQ(back.model.size(), scene.model.size());
  for (int i = 0; i < scene.model.size(); ++i) {
    const Joint &a = back.model.joint(i), &b = scene.model.joint(i);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.p_PJ, b.p_PJ);
    EXPECT_EQ(a.inertia, b.inertia);
    EXPECT_EQ(a.mirror_joint, b.mirror_joint);
    EXPECT_EQ(a.role, b.role);
    EXPECT_EQ(a.side, b.side);
    EXPECT_EQ(a.passive, b.passive);
  }
  ASSERT_EQ(back.pairs.size(), scene.pairs.size());
  for (size_t k = 0; k < scene.pairs.size(); ++k) EXPECT_EQ(back.pairs[k].mirror_pair, scene.pairs[k].mirror_pair) << k;
  EXPECT_EQ(back.leg_length, scene.leg_length);
  EXPECT_TRUE(back.symmetric);
  EXPECT_TRUE(back.selection.own);
  EXPECT_NEAR(back.selection.mass, scene.selection.mass, 1e-12 * scene.selection.mass);
}

INSTANTIATE_TEST_SUITE_P(Models, ReadBackTest,
                         ::testing::Values(std::pair{"planar", FootShape::kOneEllipsoid},
                                           std::pair{"planar", FootShape::kTwoEllipsoids},
                                           std::pair{"human29", FootShape::kOneEllipsoid},
                                           std::pair{"human29", FootShape::kTwoEllipsoids}));

// A model on superellipsoids reads back; of which sides differ in an exponent alone are no mirror images.
TEST(OwnModelTest, StandsOnSuperellipsoids) {
  BodyRequest request;
  request.model = "planar";
  request.changes.foot_exponents = {{"foot", 0.8}};
  OwnModel model = DataOf(BuildScene(request).value());
  const Result<Scene> scene = OwnScene(model);
  ASSERT_TRUE(scene.ok()) << scene.violations()[0].field << " " << scene.violations()[0].message;
  EXPECT_TRUE(scene.value().symmetric);
  ASSERT_NE(scene.value().contacts[0].surface.plain<SmoothSuperellipsoid>(), nullptr);
  model.contacts[0].surface = SmoothSuperellipsoid(*model.contacts[0].surface.semi_axes(), 0.8, 0.9, 0.1);
  const Result<Scene> uneven = OwnScene(model);
  ASSERT_FALSE(uneven.ok());
  EXPECT_EQ(uneven.violations()[0].field, "contacts[0].mirror_contact");
}

TEST(OwnModelTest, MeasuresTheLegWhereItIsNotGiven) {
  OwnModel model = Human();
  const double given = *model.leg_length;
  model.leg_length.reset();
  EXPECT_NEAR(OwnScene(model).value().leg_length, given, 0.01 * given);
}

TEST(OwnModelTest, ABodyWithoutMirrorImageMayBeUneven) {
  OwnModel model = Human();
  for (size_t i = 0; i < model.joints.size(); ++i) {
    model.joints[i].mirror_joint = static_cast<int>(i);
    model.joints[i].mirror_sign = 1;
    if (model.joints[i].name == "knee_l") model.joints[i].mass += 1;
  }
  const Result<Scene> scene = OwnScene(model);
  ASSERT_TRUE(scene.ok()) << scene.violations()[0].message;
  EXPECT_FALSE(scene.value().symmetric);
}

int Find(const OwnModel& model, const std::string& name) {
  for (size_t i = 0; i < model.joints.size(); ++i) {
    if (model.joints[i].name == name) return static_cast<int>(i);
  }
  return -1;
}
Joint& At(OwnModel* model, const char* name) { return model->joints[Find(*model, name)]; }

// As of bodies drawn in a plane, whose places are rounded.
TEST(OwnModelTest, HipsMayBeInOnePlace) {
  for (const double rounding : {0.0, 1e-9}) {
    OwnModel model = Human();
    At(&model, "hip_l").p_PJ.y() = -rounding;
    At(&model, "hip_r").p_PJ.y() = rounding;
    const Result<Scene> scene = OwnScene(model);
    EXPECT_TRUE(scene.ok()) << rounding << ": " << scene.violations()[0].field << " " << scene.violations()[0].message;
  }
}

struct Broken {
  const char* name;
  std::function<void(OwnModel*)> change;
  const char* field;  // its end, behind the index
  const char* message;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BrokenModelTest : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenModelTest, IsRefusedByFieldValueAndReason) {
  OwnModel model = Human();
  GetParam().change(&model);
  const Result<Scene> scene = OwnScene(model);
  ASSERT_FALSE(scene.ok());
  std::string said;
  bool found = false;
  for (const Violation& violation : scene.violations()) {
    said += violation.field + " " + violation.message + "\n";
    found = found || (violation.field.find(GetParam().field) != std::string::npos &&
                      violation.message.find(GetParam().message) != std::string::npos);
  }
  EXPECT_TRUE(found) << said;
  std::printf("%s", said.c_str());
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Models, BrokenModelTest,
    ::testing::Values(
        Broken{"NoJoints", [](OwnModel* m) { m->joints.clear(); }, "joints", "are 0"},
        Broken{"TooManyJoints", [](OwnModel* m) { m->joints.resize(1000000); }, "joints", "1 to 64"},
        Broken{"NameOfMarkup", [](OwnModel* m) { m->joints[3].name = "<b>"; }, "joints[3].name", "letters"},
        Broken{"NameTwice", [](OwnModel* m) { m->contacts[1].name = m->contacts[0].name; }, "contacts[1].name",
               "twice"},
        Broken{"ControlCharacter", [](OwnModel* m) { m->description = "\x1b[2J"; }, "summary.description", "control"},
        Broken{"NanOrigin", [](OwnModel* m) { At(m, "knee_l").p_PJ.x() = kNan; }, ".origin_m", "knee_l"},
        Broken{"NanMass", [](OwnModel* m) { At(m, "knee_l").mass = kNan; }, ".mass_kg", "shank_l"},
        Broken{"NegativeMass", [](OwnModel* m) { At(m, "knee_l").mass = -1; }, ".mass_kg", "is -1"},
        Broken{"Triangle", [](OwnModel* m) { At(m, "knee_l").inertia(2, 2) = 9; }, ".inertia_kg_m2", "rigid body"},
        Broken{"NegativeInertia", [](OwnModel* m) { At(m, "knee_l").inertia *= -1; }, ".inertia_kg_m2", "rigid body"},
        Broken{"ParentAfterChild", [](OwnModel* m) { At(m, "knee_l").parent = 28; }, ".parent", "before this one"},
        Broken{"FreeJoint", [](OwnModel* m) { m->joints[0].type = JointType::kFree; }, "joints[0].type", "Simulate"},
        Broken{"NoFloatingBase", [](OwnModel* m) { m->joints[2].role = JointRole::kNone; }, "joints",
               "ROLE_BASE_VERTICAL; the base must float"},
        Broken{"BaseAxis", [](OwnModel* m) { m->joints[0].axis = -Vector3::UnitX(); }, "joints[0].axis", "+x"},
        Broken{"DrivenBase", [](OwnModel* m) { m->joints[0].actuated = true; }, "joints[0].actuated", "floating"},
        Broken{"BaseRoll", [](OwnModel* m) { m->joints[4].position_max = 2; }, "joints[4].position_min", "second"},
        Broken{"NoHip", [](OwnModel* m) { At(m, "hip_r").role = JointRole::kNone; }, "joints", "right"},
        Broken{"FixedToTheWorld", [](OwnModel* m) { At(m, "shoulder_l").parent = -1; }, ".parent", "hangs on"},
        Broken{"Millimetres",
               [](OwnModel* m) {
                 for (Joint& joint : m->joints) joint.p_PJ *= 10, joint.center_of_mass *= 10;
               },
               "joints", "above the sole"},
        Broken{"Grams",
               [](OwnModel* m) {
                 for (Joint& joint : m->joints) joint.mass *= 1000, joint.inertia *= 1000;
               },
               "joints", "grams"},
        Broken{"InertiaInSquareMillimetres", [](OwnModel* m) { At(m, "knee_l").inertia *= 1e6; }, ".inertia_kg_m2",
               "kg mm²"},
        Broken{"MassOfTheWhole", [](OwnModel* m) { m->total_mass = 80; }, "total_mass_kg", "is 80"},
        Broken{"NoRange", [](OwnModel* m) { At(m, "knee_l").position_max = kInfinity; }, ".position_min", "no limits"},
        Broken{"NoSpeedLimit", [](OwnModel* m) { At(m, "knee_l").velocity_max = kInfinity; }, ".velocity_max",
               "finite"},
        Broken{"NoEffort", [](OwnModel* m) { At(m, "knee_l").effort_min = At(m, "knee_l").effort_max = 0; },
               ".effort_max", "min < 0 < max"},
        Broken{"RoleAcross", [](OwnModel* m) { At(m, "trunk_flexion").axis = Vector3::UnitX(); }, ".axis",
               "within 60°"},
        Broken{"KneeAboveTheHip",
               [](OwnModel* m) { std::swap(At(m, "hip_l").role, At(m, "knee_l").role); }, ".role",
               "is behind that of joint \"knee_l\", which does not move it"},
        Broken{"ElbowAboveTheShoulder",
               [](OwnModel* m) { std::swap(At(m, "shoulder_r").role, At(m, "elbow_r").role); }, ".role",
               "hip, knee, ankle and shoulder, elbow"},
        Broken{"AnkleAboveTheKnee",
               [](OwnModel* m) { std::swap(At(m, "knee_r").role, At(m, "ankle_r").role); }, ".role",
               "is behind that of joint \"ankle_r\", which does not move it"},
        Broken{"AnkleAboveTheHipOfALegWithoutAKnee",
               [](OwnModel* m) {
                 std::swap(At(m, "hip_l").role, At(m, "ankle_l").role);
                 At(m, "knee_l").role = JointRole::kNone;
               },
               ".role", "is behind that of joint \"ankle_l\", which does not move it"},
        Broken{"FacesBackwards",
               [](OwnModel* m) {
                 for (Joint& joint : m->joints) {
                   if (joint.side != BodySide::kMidline)
                     joint.side = joint.side == BodySide::kLeft ? BodySide::kRight : BodySide::kLeft;
                 }
                 for (ContactSurface& contact : m->contacts)
                   contact.side = contact.side == BodySide::kLeft ? BodySide::kRight : BodySide::kLeft;
               },
               ".side", "to the right of joint \"hip_l\""},
        Broken{"OtherPassive", [](OwnModel* m) { At(m, "elbow_l").passive = PassiveKind::kHumanKnee; }, ".passive",
               "people"},
        Broken{"NoFootOnTheLeft",
               [](OwnModel* m) {
                 for (ContactSurface& contact : m->contacts) contact.side = BodySide::kRight;
               },
               "contacts", "none on the left"},
        Broken{"SphericalFoot", [](OwnModel* m) { m->contacts[0].surface = Sphere(0.03); }, "contacts[0].surface",
               "ellipsoid"},
        Broken{"SharpFoot",
               [](OwnModel* m) {
                 m->contacts[0].surface = Superellipsoid(*m->contacts[0].surface.semi_axes(), 0.8, 0.8);
               },
               "contacts[0].surface", "with smoothing"},
        Broken{"FlatFoot",
               [](OwnModel* m) {
                 m->contacts[0].surface = SmoothSuperellipsoid(*m->contacts[0].surface.semi_axes(), 0.1, 1, 0.1);
               },
               "contacts[0].surface.superellipsoid.exponent_1", "is 0.1"},
        Broken{"EdgedFoot",
               [](OwnModel* m) {
                 m->contacts[0].surface = SmoothSuperellipsoid(*m->contacts[0].surface.semi_axes(), 0.8, 1, 0.02);
               },
               "contacts[0].surface.superellipsoid.smoothing", "between 0.1 and 1"},
        Broken{"ThickFoot", [](OwnModel* m) { m->contacts[0].surface = Ellipsoid(Vector3(2, 0.1, 0.1)); },
               "contacts[0].surface", "0.001"},
        Broken{"FeetAboveTheHip",
               [](OwnModel* m) {
                 for (ContactSurface& contact : m->contacts) contact.p_LE.z() += 2;
               },
               "joints", "cannot reach"},
        Broken{"FeetAboveTheShanks",
               [](OwnModel* m) {
                 for (ContactSurface& contact : m->contacts) contact.p_LE.z() += 0.6;
               },
               ".center_of_mass_m", "below the soles"},
        Broken{"OneLegShorter",
               [](OwnModel* m) {
                 for (ContactSurface& contact : m->contacts) contact.p_LE.z() += contact.name[0] == 'l' ? 0.25 : 0;
               },
               "contacts", "a fifth of the leg"},
        Broken{"MirrorMass", [](OwnModel* m) { At(m, "knee_l").mass += 0.01; }, ".mass_kg", "CYCLE_FULL"},
        Broken{"MirrorPlace", [](OwnModel* m) { At(m, "hip_l").p_PJ.y() += 0.001; }, ".origin_m", "mirror image"},
        Broken{"MirrorAxis", [](OwnModel* m) { At(m, "hip_adduction_l").axis *= -1; }, ".axis", "mirror image"},
        Broken{"MirrorRange", [](OwnModel* m) { At(m, "knee_l").position_max -= 0.1; }, ".position_min", "mirror"},
        Broken{"MirrorContact", [](OwnModel* m) { m->contacts[0].p_LE.x() += 0.01; }, "contacts[0].mirror_contact",
               "differs in centre"},
        Broken{"MirrorOutOfRange", [](OwnModel* m) { m->contacts[0].mirror_contact = 99; },
               "contacts[0].mirror_contact", "in turn"},
        Broken{"PairOutOfRange", [](OwnModel* m) { m->pairs[0].second = -5; }, "body_pairs[0]", "no body"},
        Broken{"LegLength", [](OwnModel* m) { m->leg_length = 9; }, "leg_length_m", "is 9"}),
    [](const ::testing::TestParamInfo<Broken>& broken) { return std::string(broken.param.name); });

}  // namespace
}  // namespace rollgait
