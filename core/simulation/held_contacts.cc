#include "core/simulation/held_contacts.h"

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

class HeldContacts {
 public:
  HeldContacts(const SimulationScene& scene, double t, const VectorX& x, SceneDynamics* dynamics)
      : scene_(scene), t_(t), x_(x), dynamics_(*dynamics), sliding_force_(scene.contacts.size(), Vector3::Zero()) {
    derivative_.resize(dynamics->size());
  }

  HeldChoice Choose(int let_go) {
    HeldChoice choice;
    const std::vector<int> before = dynamics_.active(), resting = Resting(let_go);
    for (int k : resting) Hold(k);
    for (int k : dynamics_.active()) {
      if (!dynamics_.IsSliding(k)) may_close_.push_back(k);
      choice.may_slide = choice.may_slide || dynamics_.MaySlide(k);
    }
    choice.outcome = Exchange(let_go);
    if (choice.outcome != HeldChoice::Outcome::kFound) return choice;
    for (int k : before) {
      if (!dynamics_.IsActive(k)) choice.let_go.push_back(k);
      if (dynamics_.IsSliding(k) && !sliding_force_[static_cast<size_t>(k)].isZero(0))
        choice.began_to_slide.push_back(k);
    }
    for (int k : resting) {
      if (dynamics_.IsActive(k)) choice.taken_up.push_back(k);
    }
    return choice;
  }

 private:
  HeldChoice::Outcome Exchange(int let_go) {
    const int contacts = dynamics_.contacts().contact_count();
    int gone = let_go;
    for (int change = 0; change <= 2 * contacts * contacts; ++change) {
      if (gone >= 0) Drop(gone);
      dynamics_.RightSide(t_, x_, &derivative_);
      if (!derivative_.allFinite()) return HeldChoice::Outcome::kNotFinite;
      // The worst first is the shortest way, the least index the one that ends (Murty 1974).
      const bool least_index = change > 2 * contacts;
      gone = Pulling(least_index);
      if (gone >= 0) {
        if (!dynamics_.IsSliding(gone)) sliding_force_[static_cast<size_t>(gone)] = dynamics_.TangentialForce(gone);
        continue;
      }
      if (change > 0 && let_go >= 0 && dynamics_.IsActive(let_go) && NormalForce(let_go) <= ForceRounding()) break;
      const int closing = Closing(least_index);
      if (closing < 0) return HeldChoice::Outcome::kFound;
      Hold(closing);
      const Vector3& force = sliding_force_[static_cast<size_t>(closing)];
      if (dynamics_.MaySlide(closing) && force.norm() > 0) dynamics_.Slide(closing, -force.normalized());
    }
    return HeldChoice::Outcome::kNone;
  }

  // Contacts that carry no force, touch and neither slip nor close; but for one.
  std::vector<int> Resting(int except) {
    std::vector<int> resting;
    dynamics_.SetState(t_, x_);
    for (int k = 0; k < dynamics_.contacts().contact_count(); ++k) {
      if (k != except && MayTouchDown(scene_, k, dynamics_) && Touches(k, &dynamics_) && dynamics_.IsAtRest(k, kAtRest))
        resting.push_back(k);
    }
    return resting;
  }

  void Drop(int contact) {
    std::vector<int> active = dynamics_.active();
    active.erase(std::remove(active.begin(), active.end(), contact), active.end());
    dynamics_.SetActive(std::move(active));
    dynamics_.Stick(contact);
  }

  void Hold(int contact) {
    std::vector<int> active = dynamics_.active();
    active.insert(std::lower_bound(active.begin(), active.end(), contact), contact);
    dynamics_.SetActive(std::move(active));
  }

  double NormalForce(int k) { return dynamics_.contacts().Kinematics(k).normal.dot(dynamics_.contacts().Force(k)); }
  // What a normal force is in error by, N.
  double ForceRounding() {
    double largest = 0;
    for (int k : dynamics_.active()) largest = std::max(largest, dynamics_.contacts().Force(k).norm());
    return kForceRounding * largest;
  }

  // The one-way contact that pulls most under the last right side, or the first that pulls; -1: none.
  int Pulling(bool first) {
    int worst = -1;
    double least = -ForceRounding();
    for (int k : dynamics_.active()) {
      if (scene_.contacts[static_cast<size_t>(k)].bilateral) continue;
      const double normal = NormalForce(k);
      if (!(normal < least)) continue;
      least = normal, worst = k;
      if (first) break;
    }
    return worst;
  }

  // The contact that was let go and whose gap closes fastest under the last right side, or the first that closes; -1:
  // none.
  int Closing(bool first) {
    int fastest = -1;
    double least = 0;
    for (int k : may_close_) {
      if (dynamics_.IsActive(k)) continue;
      const double acceleration = dynamics_.GapAcceleration(k);
      if (!(acceleration < least)) continue;
      least = acceleration, fastest = k;
      if (first) break;
    }
    return fastest;
  }

  const SimulationScene& scene_;
  const double t_;
  const VectorX& x_;
  SceneDynamics& dynamics_;
  std::vector<int> may_close_;          // those that do not slip: of them GapAcceleration is known
  std::vector<Vector3> sliding_force_;  // N, of those that pulled: what held them along the ground
  VectorX derivative_;
};

}  // namespace

bool MayTouchDown(const SimulationScene& scene, int contact, const SceneDynamics& dynamics) {
  const SceneContact& of_scene = scene.contacts[static_cast<size_t>(contact)];
  return !dynamics.IsActive(contact) && of_scene.can_touch_down && of_scene.gates.empty();
}

bool Touches(int contact, SceneDynamics* dynamics) {
  const PairKinematics& pair = dynamics->contacts().Kinematics(contact);
  return std::abs(pair.gap) <= kTouching * (1 + pair.p_1.norm());
}

HeldChoice ChooseHeldContacts(const SimulationScene& scene, int let_go, double t, const VectorX& x,
                              SceneDynamics* dynamics) {
  return HeldContacts(scene, t, x, dynamics).Choose(let_go);
}

}  // namespace rollgait
