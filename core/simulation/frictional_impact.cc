#include "core/simulation/frictional_impact.h"

#include "core/simulation/held_contacts.h"

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

}  // namespace

std::optional<Impact> ResolveTouchDown(const SimulationScene& scene, int contact, double t, const VectorX& x,
                                       SceneDynamics* dynamics) {
  dynamics->SetState(t, x);
  std::vector<int> touching, must_hold, bilateral;
  for (int k = 0; k < dynamics->contacts().contact_count(); ++k) {
    const bool closes_too =
        MayTouchDown(scene, k, *dynamics) && Touches(k, dynamics) && dynamics->contacts().Kinematics(k).gap_rate <= 0;
    if (k != contact && !dynamics->IsActive(k) && !closes_too) continue;
    touching.push_back(k);
    const bool stays = scene.contacts[static_cast<size_t>(k)].bilateral;
    if (stays) bilateral.push_back(k);
    if (k == contact || stays) must_hold.push_back(k);
  }
  std::optional<Impact> impact = ResolveFrictionalImpact(scene, touching, must_hold, t, x, dynamics);
  if (!impact || impact->consistent) return impact;
  // Others that close at the same instant may open this one again.
  std::optional<Impact> other = ResolveFrictionalImpact(scene, touching, bilateral, t, x, dynamics);
  if (other && other->consistent) return other;
  return ResolveFrictionalImpact(scene, touching, must_hold, t, x, dynamics);
}

}  // namespace rollgait
