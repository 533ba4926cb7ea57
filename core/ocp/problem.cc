#include "core/ocp/problem.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/ocp/constraints/approach.h"
#include "core/ocp/constraints/contact_point.h"
#include "core/ocp/constraints/dynamics.h"
#include "core/ocp/constraints/force_shares.h"
#include "core/ocp/constraints/friction.h"
#include "core/ocp/constraints/rolling.h"
#include "core/ocp/constraints/separation.h"

namespace rollgait {
namespace {

bool Contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

}  // namespace

std::vector<int> OptimalControlProblem::PreviousActive(int phase) const {
  if (phase > 0) return phases[phase - 1].active;
  if (ends) return {};
  std::vector<int> previous = phases.back().active;
  if (mirrored) {
    for (int& contact : previous) contact = contacts[contact].mirror_contact;
  }
  return previous;
}

bool OptimalControlProblem::Jumps(int phase) const {
  if (!plastic_touch_down || (phase == 0 && ends)) return false;
  const std::vector<int> previous = PreviousActive(phase);
  const std::vector<int>& active = phases[phase].active;
  return std::any_of(active.begin(), active.end(), [&](int contact) { return !Contains(previous, contact); });
}

std::vector<int> OptimalControlProblem::TakenUp(int phase) const {
  const std::vector<int> previous = PreviousActive(phase);
  std::vector<int> contacts_taken;
  for (int contact : phases[phase].active) {
    if (!Contains(previous, contact)) contacts_taken.push_back(contact);
  }
  return contacts_taken;
}

std::vector<int> OptimalControlProblem::GivenUp(int phase) const {
  const int count = static_cast<int>(phases.size());
  const bool wraps = phase + 1 == count;
  if (wraps && ends) return {};
  const std::vector<int>& next = phases[wraps ? 0 : phase + 1].active;
  std::vector<int> given;
  for (int contact : phases[phase].active) {
    const int seen = wraps && mirrored ? contacts[contact].mirror_contact : contact;
    if (!Contains(next, seen)) given.push_back(contact);
  }
  return given;
}

namespace {

bool EffortsAreContinuous(const std::vector<CostDescription>& costs) {
  return std::any_of(costs.begin(), costs.end(), [](const CostDescription& cost) {
    return cost.IsRateOf(RateCost::Of::kEfforts) && cost.weight > 0 &&
           std::get<RateCost>(cost.term).weights.minCoeff() > 0;
  });
}

}  // namespace

bool OptimalControlProblem::ForcesVanishAtStart(int phase) const {
  return min_normal_force == 0 && !Jumps(phase) && !(phase == 0 && ends) && EffortsAreContinuous(costs);
}

bool OptimalControlProblem::ForcesVanishAtEnd(int phase) const {
  const bool last = phase + 1 == static_cast<int>(phases.size());
  return min_normal_force == 0 && !(last && ends) && !Jumps(last ? 0 : phase + 1) && EffortsAreContinuous(costs);
}

int OptimalControlProblem::StandingFeet(int phase) const {
  int own = 0;
  bool left = false, right = false;
  for (int contact : phases[phase].active) {
    left |= contact < contacts[contact].mirror_contact;
    right |= contact > contacts[contact].mirror_contact;
    own += contact == contacts[contact].mirror_contact ? 1 : 0;
  }
  return own + (left ? 1 : 0) + (right ? 1 : 0);
}

std::vector<ContactSurface> OptimalControlProblem::PhaseContacts(int phase) const {
  std::vector<ContactSurface> seen = contacts;
  std::vector<int> links;
  for (int contact : phases[phase].active) {
    ContactSurface& surface = seen[contact];
    if (Contains(links, surface.joint)) std::erase(surface.directions, 0);
    links.push_back(surface.joint);
  }
  return seen;
}

std::vector<ActiveContact> OptimalControlProblem::ActiveContacts(int phase) const {
  std::vector<ActiveContact> active;
  int offset = 0;
  for (int contact : phases[phase].active) {
    active.push_back({contact, offset, contacts[contact].directions});
    offset += static_cast<int>(contacts[contact].directions.size());
  }
  return active;
}

PointLayout OptimalControlProblem::Layout(int phase) const {
  PointLayout layout;
  layout.n = model.size();
  layout.efforts = static_cast<int>(model.actuated().size());
  for (const ActiveContact& contact : ActiveContacts(phase)) {
    layout.forces += static_cast<int>(contact.directions.size());
  }
  return layout;
}

Interval OptimalControlProblem::EffortBounds(int phase, int effort) const {
  const Joint& joint = model.joint(model.actuated()[static_cast<size_t>(effort)]);
  Interval bounds{joint.effort_min, joint.effort_max};
  const std::vector<Interval>& own = phases[phase].efforts;
  if (!own.empty()) {
    ROLLGAIT_CHECK(own.size() == model.actuated().size());
    bounds.min = std::max(bounds.min, own[static_cast<size_t>(effort)].min);
    bounds.max = std::min(bounds.max, own[static_cast<size_t>(effort)].max);
    ROLLGAIT_CHECK(bounds.min <= bounds.max);
  }
  return bounds;
}

std::vector<std::unique_ptr<PointConstraint>> OptimalControlProblem::PointConstraints(
    int phase, PointKind kind, const std::vector<int>& separated) const {
  std::vector<std::unique_ptr<PointConstraint>> constraints;
  const PointLayout layout = Layout(phase);
  const auto active = ActiveContacts(phase);
  const std::vector<ContactSurface> seen = PhaseContacts(phase);
  if (equations_of_motion) {
    ROLLGAIT_CHECK(contacts.empty());
    constraints.push_back(equations_of_motion(layout));
  } else {
    constraints.push_back(
        std::make_unique<DynamicsConstraint>(model, contacts, active, layout, force_size(), effort_size()));
  }
  for (const ActiveContact& contact : active) {
    if (kind != PointKind::kCollocation) {
      constraints.push_back(std::make_unique<RollingAccelerationConstraint>(model, seen, contact.contact, layout));
    } else {
      constraints.push_back(std::make_unique<RollingVelocityConstraint>(model, seen, contact.contact, layout));
    }
  }
  auto shares = MakeForceShares(contacts, active, layout, force_size());
  if (shares) constraints.push_back(std::move(shares));
  // Of a node gaps and distances are bounded in the interval before.
  if (kind == PointKind::kNode) return constraints;
  for (int c = 0; c < static_cast<int>(contacts.size()); ++c) {
    if (Contains(phases[phase].active, c)) continue;
    constraints.push_back(
        std::make_unique<GapConstraint>(model, contacts, c, layout, GapConstraint::Kind::kClearance, swing_clearance));
  }
  for (size_t s = 0; s < separated.size(); ++s) {
    const BodyPair& pair = pairs[separated[s]];
    constraints.push_back(
        std::make_unique<SeparationConstraint>(model, bodies[pair.first], bodies[pair.second], layout, pair_clearance));
  }
  return constraints;
}

std::vector<std::unique_ptr<PointConstraint>> OptimalControlProblem::EntryConstraints(int phase) const {
  std::vector<std::unique_ptr<PointConstraint>> constraints;
  PointLayout layout;
  layout.n = model.size();
  const std::vector<int> previous = PreviousActive(phase);
  const std::vector<ContactSurface> seen = PhaseContacts(phase);
  const bool jumps = Jumps(phase);
  for (int contact : phases[phase].active) {
    const bool stays = Contains(previous, contact);
    if (!stays) {
      constraints.push_back(
          std::make_unique<GapConstraint>(model, contacts, contact, layout, GapConstraint::Kind::kTouching, 0));
    }
    if (!stays || jumps) {
      constraints.push_back(std::make_unique<RollingVelocityConstraint>(model, seen, contact, layout));
    }
    if (!stays && touch_down_point) {
      constraints.push_back(std::make_unique<SurfacePointConstraint>(model, contacts, contact, layout,
                                                                     touch_down_point->min, touch_down_point->max));
    }
  }
  for (int contact : previous) {
    if (lift_off_point && !Contains(phases[phase].active, contact)) {
      constraints.push_back(std::make_unique<SurfacePointConstraint>(model, contacts, contact, layout,
                                                                     lift_off_point->min, lift_off_point->max));
    }
  }
  return constraints;
}

PointLayout OptimalControlProblem::JumpLayout(int phase) const {
  PointLayout layout = Layout(phase);
  layout.efforts = 0;
  return layout;
}

std::vector<std::unique_ptr<PointConstraint>> OptimalControlProblem::JumpConstraints(int phase) const {
  std::vector<std::unique_ptr<PointConstraint>> constraints;
  const PointLayout layout = JumpLayout(phase);
  const auto active = ActiveContacts(phase);
  constraints.push_back(
      std::make_unique<DynamicsConstraint>(model, contacts, active, layout, impulse_size(), lever * impulse_size()));
  for (int contact : TakenUp(phase)) {
    constraints.push_back(std::make_unique<ApproachConstraint>(model, contacts, contact, layout));
  }
  std::vector<ForceRow> friction = FrictionRows(contacts, active, friction_coefficient);
  if (!friction.empty()) {
    constraints.push_back(std::make_unique<FrictionConstraint>(std::move(friction), layout, impulse_size()));
  }
  return constraints;
}

}  // namespace rollgait
