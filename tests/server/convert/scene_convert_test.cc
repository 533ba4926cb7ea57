#include "server/convert/scene_convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "tests/server/shipped_scene.h"

namespace rollgait::server {
namespace {

TEST(ShippedScenes, AreValidAndRun) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ROLLGAIT_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().filename().string();
    ++count;
    v1::SimulationScene message = ReadShipped(name);
    Result<SimulationScene> decoded = DecodeScene(message);
    ASSERT_TRUE(decoded.ok()) << name << ": " << decoded.violations()[0].field << " "
                              << decoded.violations()[0].message;
    SimulationScene scene = std::move(decoded).value();
    scene.options.duration = std::min(scene.options.duration, 1.0);
    const Result<SimulationReport> report = Simulate(scene, {});
    ASSERT_TRUE(report.ok()) << name << ": " << report.violations()[0].message;
    EXPECT_EQ(report.value().end, SimulationEnd::kDuration) << name;
    EXPECT_LT(report.value().max_energy_error, 1e-7) << name;
    EXPECT_FALSE(report.value().redundant) << name;
  }
  EXPECT_GE(count, 11);
}

TEST(ShippedScenes, WalkersHavePeriodicGaits) {
  const struct {
    const char* file;
    double stance, largest;  // angle of the fixed point, largest |eigenvalue|, from the reference data
    double tolerance;
  } walkers[] = {{"compass_gait.json", 0.2710286804988204, 0.5799, 1e-10},
                 {"round_foot_walker.json", 0.1894382832527027, 0.43344, 1e-10},
                 {"elliptic_foot_walker.json", 0.2340206008273496, 0.38932, 1e-10},
                 {"simplest_walker.json", 0.20031090054424708, 0.58912, 1e-9}};  // feet of 1e-9 hip masses
  for (const auto& walker : walkers) {
    const Result<SimulationScene> scene = DecodeScene(ReadShipped(walker.file));
    ASSERT_TRUE(scene.ok());
    const Result<PeriodicGait> gait = FindPeriodicGait(scene.value(), {});
    ASSERT_TRUE(gait.ok()) << walker.file << gait.violations()[0].message;
    EXPECT_TRUE(gait.value().converged) << walker.file << " " << gait.value().residual;
    EXPECT_NEAR(gait.value().q[2], walker.stance, walker.tolerance) << walker.file;
    EXPECT_NEAR(std::abs(gait.value().eigenvalues[0]), walker.largest, 1e-4) << walker.file;
    const v1::PeriodicGait encoded = EncodeGait(gait.value(), scene.value());
    EXPECT_TRUE(encoded.stable());
    EXPECT_EQ(encoded.eigenvalues_size(), 3);
    EXPECT_EQ(encoded.heel_strike().contact(), "foot_2");
    EXPECT_GT(encoded.step_length_m(), 0.1);
  }
}

// What is wrong with a scene after a change of a good one; "nothing" if nothing is.
std::string FirstField(const std::function<void(v1::SimulationScene&)>& change) {
  v1::SimulationScene scene = ReadShipped("elliptic_foot_walker.json");
  change(scene);
  const Result<SimulationScene> decoded = DecodeScene(scene);
  return decoded.ok() ? "nothing" : decoded.violations()[0].field;
}

TEST(SceneConvert, NamesTheFieldThatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(FirstField([](auto&) {}), "nothing");
  EXPECT_EQ(FirstField([](auto& s) { s.clear_joints(); }), "joints");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_joints(2)->set_mass_kg(0); }), "joints[2].inertia_kg_m2");
  EXPECT_EQ(FirstField([&](auto& s) { s.mutable_joints(2)->set_mass_kg(nan); }), "joints[2].mass_kg");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_joints(2)->set_inertia_kg_m2(0, 5); }), "joints[2].inertia_kg_m2");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_joints(2)->set_parent("nobody"); }), "joints[2].parent");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_joints(2)->set_type(v1::Joint::TYPE_UNSPECIFIED); }), "joints[2].type");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_joints(2)->mutable_axis()->set_y(0); }), "joints[2].axis");
  EXPECT_EQ(FirstField([&](auto& s) { s.mutable_joints(3)->mutable_initial()->set_velocity(nan); }),
            "joints[3].initial.velocity");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_contacts(0)->mutable_body()->set_joint("nobody"); }),
            "contacts[0].body.joint");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_contacts(0)->mutable_body()->clear_surface(); }),
            "contacts[0].body.surface");
  EXPECT_EQ(
      FirstField([](auto& s) {
        s.mutable_contacts(1)->mutable_body()->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m()->set_x(-1);
      }),
      "contacts[1].body.surface.ellipsoid.semi_axes_m");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_contacts(1)->mutable_plane()->set_ground("moon"); }),
            "contacts[1].plane.ground");
  EXPECT_EQ(FirstField([](auto& s) {
              s.mutable_contacts(1)->mutable_along()->set_z(1), s.mutable_contacts(1)->mutable_along()->set_x(0);
            }),
            "contacts[1].along");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_contacts(1)->mutable_gates(1)->set_joint(""); }),
            "contacts[1].gates[1].joint");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_contacts(1)->set_name("foot_1"); }), "contacts[1].name");
  EXPECT_EQ(FirstField([](auto& s) { s.add_ground()->set_name("g"), s.mutable_ground(0)->set_frequency_hz(-1); }),
            "ground[0].frequency_hz");
  EXPECT_EQ(FirstField([](auto& s) { s.set_duration_s(1e12); }), "duration_s");
  for (const double friction : {-0.2, 0.0, nan}) {
    EXPECT_EQ(FirstField([&](auto& s) { s.mutable_contacts(0)->set_friction(friction); }), "contacts[0].friction");
  }
  EXPECT_EQ(FirstField([](auto& s) {
              s.mutable_contacts(0)->clear_friction();
              s.mutable_contacts(0)->set_friction_loss(v1::SceneContact::FRICTION_LOSS_SLIDE);
            }),
            "contacts[0].friction_loss");
  EXPECT_EQ(FirstField([](auto& s) { s.clear_duration_s(); }), "duration_s");
  EXPECT_EQ(FirstField([](auto& s) { s.set_output_step_s(1e-9); }), "output_step_s");
  EXPECT_EQ(FirstField([](auto& s) { s.set_max_steps(-5); }), "max_steps");
  EXPECT_EQ(FirstField([](auto& s) { s.mutable_drift()->set_kind(static_cast<v1::DriftControl::Kind>(77)); }),
            "drift.kind");
  EXPECT_EQ(FirstField([](auto& s) { s.set_travel_joint("nobody"); }), "travel_joint");
}

// A boxy body that rocks on its face: flat, the rolling constraint does not exist there; with a flattening or a
// smoothing it does.
TEST(SceneConvert, AFlatteningLetsABoxRockOnItsFace) {
  v1::SimulationScene scene = ReadShipped("triaxial_ellipsoid.json");
  v1::Quaternion* const upright = scene.mutable_joints(0)->mutable_initial()->mutable_orientation();
  upright->set_w(1), upright->set_x(0), upright->set_y(0), upright->set_z(0);
  scene.set_duration_s(0.5);
  v1::Surface* const surface = scene.mutable_contacts(0)->mutable_body()->mutable_surface();
  const v1::Vector3 axes = surface->ellipsoid().semi_axes_m();
  v1::Superellipsoid* const box = surface->mutable_superellipsoid();
  *box->mutable_semi_axes_m() = axes;
  box->set_exponent_1(0.5), box->set_exponent_2(0.5);
  const auto end = [&] {
    const Result<SimulationScene> decoded = DecodeScene(scene);
    EXPECT_TRUE(decoded.ok());
    const Result<SimulationReport> report = Simulate(decoded.value(), {});
    return report.ok() ? report.value().end : SimulationEnd::kNotFinite;
  };
  EXPECT_EQ(end(), SimulationEnd::kNotFinite);
  box->set_flattening(0.05);
  EXPECT_EQ(end(), SimulationEnd::kDuration);
  box->set_flattening(0), box->set_smoothing(0.1);
  EXPECT_EQ(end(), SimulationEnd::kDuration);
  box->set_smoothing(0), box->set_flattening(1e-9);
  const Result<SimulationScene> refused = DecodeScene(scene);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.violations()[0].field, "contacts[0].body.surface.superellipsoid.flattening");
}

TEST(SceneConvert, NamesValueAndLimit) {
  v1::SimulationScene scene = ReadShipped("ball_flat.json");
  scene.set_tolerance(1);
  const Result<SimulationScene> decoded = DecodeScene(scene);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.violations()[0].message, "is 1; must be within [1e-14, 0.01]");
}

}  // namespace
}  // namespace rollgait::server
