// Every kind of surface by the way of a request: over the wire, into a simulation, under a walker, before the judge and
// in the client's pictures. A new kind needs its rows alone: the cases are those of surface_cases.cc.
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "client/report/surface_shape.h"
#include "core/contact/pair_separation.h"
#include "core/models/catalog.h"
#include "core/models/own_model.h"
#include "core/simulation/simulation.h"
#include "core/validation/body_overlap.h"
#include "server/convert/surface_convert.h"
#include "tests/conformance/surface_cases.h"
#include "tests/support/matrix_near.h"
#include "tests/support/rolling_scenes.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

constexpr double kScale = 0.1;  // m: the cases are about this large

v1::Surface OnTheWire(const Surface& surface) {
  v1::Surface message;
  server::EncodeSurface(surface, &message);
  return message;
}

bool IsSaid(const v1::Surface& message) { return message.shape_case() != v1::Surface::SHAPE_NOT_SET; }

class EverySurface : public ::testing::TestWithParam<SurfaceCase> {
 protected:
  const Surface surface_ = GetParam().make(kScale);
  SeededRandom random_{20261127};
};

TEST_P(EverySurface, ComesBackFromTheWire) {
  const v1::Surface message = OnTheWire(surface_);
  if (!IsSaid(message)) GTEST_SKIP() << "no message says it";
  Violations violations;
  const std::optional<Surface> back = server::DecodeSurface("surface", message, &violations);
  ASSERT_TRUE(back) << violations[0].field << " " << violations[0].message;
  EXPECT_EQ(back->kind().index(), surface_.kind().index());
  for (int i = 0; i < 100; ++i) {
    const Vector3 nu = random_.Unit();
    EXPECT_EQ(back->Support(nu), surface_.Support(nu));
  }
}

// Calls visit(path, setter) for every number of a message, those of its messages with it.
template <typename Visit>
void ForEachNumber(google::protobuf::Message* message, const std::string& path, const Visit& visit) {
  const google::protobuf::Reflection& reflection = *message->GetReflection();
  for (int i = 0; i < message->GetDescriptor()->field_count(); ++i) {
    const auto* field = message->GetDescriptor()->field(i);
    const std::string name = path + "." + field->name();
    if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) {
      const double before = reflection.GetDouble(*message, field);
      visit(name, [&](double value) { reflection.SetDouble(message, field, value); });
      reflection.SetDouble(message, field, before);
    } else if (reflection.HasField(*message, field)) {
      ForEachNumber(reflection.MutableMessage(message, field), name, visit);
    }
  }
}

TEST_P(EverySurface, IsRefusedByFieldWhereANumberIsWrong) {
  v1::Surface message = OnTheWire(surface_);
  if (!IsSaid(message)) GTEST_SKIP() << "no message says it";
  int numbers = 0;
  ForEachNumber(&message, "surface", [&](const std::string& path, const auto& set) {
    ++numbers;
    for (const double wrong : {std::nan(""), -std::nan(""), -kInfinity, kInfinity, -1.0, -1e-300}) {
      set(wrong);
      Violations violations;
      ASSERT_FALSE(server::DecodeSurface("surface", message, &violations)) << path << " " << wrong;
      ASSERT_FALSE(violations.empty()) << path;
      // The field that holds the number, or the one beside it with which it cannot be.
      const std::string parent = path.substr(0, path.find('.', path.find('.') + 1));
      for (const Violation& violation : violations) {
        EXPECT_EQ(violation.field.rfind(parent, 0), 0u) << violation.field << " for " << path << " " << wrong;
        EXPECT_FALSE(violation.message.empty());
      }
    }
  });
  EXPECT_GE(numbers, 2);
}

TEST_P(EverySurface, RollsInASimulation) {
  if (GetParam().least_component > 0) GTEST_SKIP() << "has flats or edges, on which nothing rolls";
  BodyOnPlane body;
  body.surface = surface_;
  body.mass = 2;
  body.inertia = 0.4 * body.mass * kScale * kScale * Matrix3::Identity();
  body.orientation = Eigen::Quaterniond(0.8, 0.36, 0.288, 0.38);
  body.omega_body = Vector3(3, -4, 2);
  SimulationScene scene = SceneOf(body);
  scene.options.duration = 0.5;
  scene.options.output_step = 0.1;
  scene.options.tolerance = 1e-10;
  ASSERT_TRUE(CheckScene(scene).empty());
  int samples = 0;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    ++samples;
    // It rests on the plane, at the point that its support function says.
    const Eigen::Quaterniond q(sample.q[0], sample.q[1], sample.q[2], sample.q[3]);
    const Vector3 lowest = q.normalized() * surface_.SupportPoint(q.normalized().inverse() * Vector3(0, 0, -1));
    EXPECT_NEAR(lowest.z() + sample.q[6], 0, 1e-9) << sample.time;
    return true;
  };
  const Result<SimulationReport> report = Simulate(scene, observer);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.value().end, SimulationEnd::kDuration);
  EXPECT_LT(report.value().max_energy_error, 1e-7);
  EXPECT_EQ(samples, 6);
}

// What walks is a foot of an own model, within the bounds that it says.
TEST_P(EverySurface, IsAFootIfItWalks) {
  BodyRequest request;
  request.model = "planar";
  const Scene planar = BuildScene(request).value();
  OwnModel model{planar.name, planar.description, planar.model.joints(), planar.contacts, planar.bodies, planar.pairs,
                 {},          planar.leg_length,  planar.sources};
  for (ContactSurface& contact : model.contacts) contact.surface = surface_;
  const Result<Scene> scene = OwnScene(model);
  EXPECT_EQ(surface_.walking().has_value(), surface_.semi_axes() != nullptr);
  const bool refused = !scene.ok() && scene.violations()[0].field == "contacts[0].surface";
  EXPECT_EQ(refused, !surface_.walking());
  const std::optional<WalkingShape> shape = surface_.walking();
  if (!shape) return;
  ASSERT_TRUE(scene.ok()) << scene.violations()[0].field << " " << scene.violations()[0].message;
  EXPECT_EQ(OnTheWire(surface_).GetDescriptor()->FindFieldByName(shape->field)->number(),
            OnTheWire(surface_).shape_case());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(surface_.Support(Vector3::Unit(i)), shape->semi_axes[i], 1e-15);
}

// The judge's own support function is that of the surface, and so are distances.
TEST_P(EverySurface, IsJudgedAsItIsIfItWalks) {
  const std::optional<WalkingShape> shape = surface_.walking();
  if (!shape) GTEST_SKIP() << "it does not walk";
  PosedBody a;
  a.semi_axes = shape->semi_axes;
  if (shape->support) a.norm = std::make_shared<const std::function<double(const Vector3&)>>(shape->support);
  PosedBody b = a;
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector3 nu = random_.Unit();
    if (shape->support) {
      EXPECT_NEAR(shape->support(3 * nu), 3 * surface_.Support(nu), 1e-15);
    }
    b.R_WE = Eigen::AngleAxisd(random_.Uniform(-3, 3), random_.Unit()).toRotationMatrix();
    b.p_WE = random_.Unit() * random_.Uniform(0.5, 3) * kScale;
    const Separation separation = FindSeparation({&surface_, a.R_WE, a.p_WE}, {&surface_, b.R_WE, b.p_WE}, nullptr);
    const ScaledContact contact = FindScaledContact(a, b);
    EXPECT_EQ(separation.state == Separation::State::kOverlap, contact.scale < 1) << i;
    EXPECT_LE(PlaneDistance(a, b, contact.nu), separation.distance + 1e-14);
    ++(contact.scale > 1 ? apart : overlapping);
  }
  EXPECT_GT(apart, 5);
  EXPECT_GT(overlapping, 5);
}

// Pictures and tables of the client show the surface that walks.
TEST_P(EverySurface, IsDrawnAsItIsIfItWalks) {
  const v1::Surface message = OnTheWire(surface_);
  EXPECT_EQ(client::MayWalk(message) && surface_.walking(), surface_.walking().has_value());
  if (!surface_.walking()) return;
  const client::SurfaceShape shape = client::ShapeOf(message);
  EXPECT_TRUE(MatrixNear(shape.semi_axes, surface_.walking()->semi_axes, 1e-15));
  for (int i = 0; i < 100; ++i) {
    const Vector3 nu = random_.Unit();
    EXPECT_TRUE(MatrixNear(shape.FurthestPoint(nu), surface_.SupportPoint(nu), 1e-14));
  }
  EXPECT_EQ(shape.numbers.empty(), surface_.walking()->numbers.empty());
}

INSTANTIATE_TEST_SUITE_P(Surfaces, EverySurface, ::testing::ValuesIn(SurfaceCases()),
                         [](const auto& case_info) { return case_info.param.name; });

// Every shape of the message has a case that walks the way above.
TEST(EverySurfaceTest, HasACase) {
  std::set<int> said;
  for (const SurfaceCase& surface_case : SurfaceCases()) said.insert(OnTheWire(surface_case.make(1)).shape_case());
  const auto* const shapes = v1::Surface::descriptor()->FindOneofByName("shape");
  for (int i = 0; i < shapes->field_count(); ++i) {
    EXPECT_EQ(said.count(shapes->field(i)->number()), 1u) << shapes->field(i)->name();
  }
}

}  // namespace
}  // namespace rollgait
