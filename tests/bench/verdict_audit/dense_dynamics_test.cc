// The dense dynamics against those of core/contact, which share no code with it but the tree of the model.
#include "bench/verdict_audit/dense_dynamics.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/verdict_audit/kinematics.h"
#include "core/contact/constrained_dynamics.h"
#include "core/models/catalog.h"
#include "core/multibody/body_dynamics.h"

namespace rollgait::audit {
namespace {

const Vector3 kGravity(-1.2, 0, -9.7);

Scene SceneOf(const std::string& model, FootShape feet) {
  BodyRequest request;
  request.model = model;
  request.feet = feet;
  return BuildScene(request).value();
}

// A state without meaning: the equations hold wherever the surfaces are.
struct Case {
  explicit Case(const Scene& scene, unsigned seed) {
    std::srand(seed);
    q = 0.3 * VectorX::Random(scene.model.size());
    v = 2 * VectorX::Random(scene.model.size());
    efforts = 50 * VectorX::Random(static_cast<Eigen::Index>(scene.model.actuated().size()));
    tau = VectorX::Zero(scene.model.size());
    for (size_t a = 0; a < scene.model.actuated().size(); ++a)
      tau[scene.model.actuated()[a]] = efforts[static_cast<Eigen::Index>(a)];
  }
  VectorX q, v, efforts, tau;
};

TEST(DenseDynamics, AgreesWithContactDynamics) {
  for (const char* model : {"planar", "human29"}) {
    const Scene scene = SceneOf(model, FootShape::kOneEllipsoid);
    const BodyDynamics body(scene.model);
    for (const std::vector<int>& contacts : {std::vector<int>{}, {0}, {1}, {0, 1}}) {
      std::vector<ContactSurface> surfaces;
      for (const int c : contacts) surfaces.push_back(scene.contacts[static_cast<size_t>(c)]);
      ConstrainedDynamics core(body, surfaces);
      DenseDynamics dense(scene, contacts, kGravity);
      for (unsigned seed = 1; seed <= 5; ++seed) {
        const Case at(scene, seed);
        const VectorX expected = core.Evaluate(at.q, at.v, at.tau, kGravity).acceleration;
        const DenseDynamics::Answer answer = dense.Evaluate(at.q, at.v, at.efforts);
        // The difference quotient of J costs 1e-9 of the velocities' squares; the lightest links are that much more
        // mobile.
        EXPECT_LT((answer.acceleration - expected).norm(), 1e-6 * expected.norm()) << model << seed;
        ASSERT_EQ(answer.forces.size(), contacts.size());
        for (size_t c = 0; c < contacts.size(); ++c) {
          EXPECT_LT((answer.forces[c] - core.Force(static_cast<int>(c))).norm(),
                    1e-6 * core.Force(static_cast<int>(c)).norm());
        }
      }
    }
  }
}

TEST(DenseDynamics, EnergyAndMomentumAgree) {
  const Scene scene = SceneOf("human29", FootShape::kTwoEllipsoids);
  const BodyDynamics body(scene.model);
  const Case at(scene, 3);
  BodyDynamics::State state;
  body.ComputeState(at.q, at.v, &state);
  const std::vector<LinkPose> poses = Poses(scene.model, at.q, at.v);
  const double energy = body.KineticEnergy(state) + body.PotentialEnergy(state, kGravity);
  EXPECT_NEAR(Energy(scene.model, poses, kGravity), energy, 1e-10 * std::abs(energy));
  EXPECT_LT((Momentum(scene.model, poses) - body.LinearMomentum(state)).norm(), 1e-10);
}

// Two surfaces of one rigid foot: the rows depend on each other, and after the impact all contacts stand still.
TEST(DenseDynamics, AnImpactStopsEveryContact) {
  const Scene scene = SceneOf("human29", FootShape::kTwoEllipsoids);
  const std::vector<int> contacts = {0, 1};
  ASSERT_EQ(scene.contacts[0].joint, scene.contacts[1].joint);
  const Case at(scene, 4);
  const DenseDynamics::Impact impact = DenseDynamics(scene, contacts, kGravity).Stop(at.q, at.v);
  EXPECT_GT((impact.velocity - at.v).norm(), 0.1);
  const std::vector<LinkPose> poses = Poses(scene.model, at.q, impact.velocity);
  for (const int c : contacts) {
    EXPECT_LT(FindLowestPoint(scene.contacts[static_cast<size_t>(c)], poses).velocity.norm(), 1e-9);
  }
}

}  // namespace
}  // namespace rollgait::audit
