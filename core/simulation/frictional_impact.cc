#include "core/simulation/frictional_impact.h"

namespace rollgait {
namespace {

// Of an impulse: what rounding adds to a ratio.
constexpr double kRounding = 1e-11;

// Lets those held contacts slide whose impulse is beyond their cone. True if there was one.
bool LetSlide(const SimulationScene& scene, const Impact& impact, SceneDynamics* dynamics) {
  bool changed = false;
  for (int k : impact.held) {
    if (!dynamics->MaySlide(k) || dynamics->IsSliding(k)) continue;
    const Vector3& n = dynamics->contacts().Kinematics(k).normal;
    const Vector3& impulse = impact.impulses[static_cast<size_t>(k)];
    const double normal = n.dot(impulse);
    const Vector3 along = impulse - normal * n, slip = dynamics->TangentialSlip(k);
    if (along.norm() <= scene.contacts[static_cast<size_t>(k)].friction * normal * (1 + kRounding)) continue;
    dynamics->Slide(k, slip.norm() > kSlidingBlend ? slip.normalized() : Vector3(-along.normalized()));
    changed = true;
  }
  return changed;
}

}  // namespace

std::optional<Impact> ResolveFrictionalImpact(const SimulationScene& scene, const std::vector<int>& touching,
                                              const std::vector<int>& must_hold, double t, const VectorX& x,
                                              SceneDynamics* dynamics) {
  dynamics->SetState(t, x);
  for (int k : touching) {
    if (dynamics->MaySlide(k)) dynamics->Stick(k);
  }
  Impact impact;
  do {
    impact = ResolveImpact(touching, must_hold, &dynamics->contacts());
    if (!impact.velocity.allFinite()) return std::nullopt;
  } while (LetSlide(scene, impact, dynamics));
  VectorX after = x;
  after.segment(scene.model.nq(), scene.model.nv()) = impact.velocity;
  dynamics->SetState(t, after);
  for (int k : impact.held) {
    if (dynamics->IsSliding(k) && dynamics->contacts().SlipAlongReference(k) < 0) return std::nullopt;
  }
  dynamics->SetState(t, x);
  return impact;
}

}  // namespace rollgait
