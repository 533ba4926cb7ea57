#include "core/ocp/problem.h"

#include <algorithm>

#include "core/ocp/constraints/contact_point.h"
#include "core/ocp/constraints/dynamics.h"
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
  const std::vector<ContactSurface> seen = PhaseContacts(phase);
  std::vector<ActiveContact> active;
  int offset = 0;
  for (int contact : phases[phase].active) {
    active.push_back({contact, offset, seen[contact].directions});
    offset += static_cast<int>(seen[contact].directions.size());
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

std::vector<std::unique_ptr<PointConstraint>> OptimalControlProblem::PointConstraints(int phase, bool at_node) const {
  std::vector<std::unique_ptr<PointConstraint>> constraints;
  const PointLayout layout = Layout(phase);
  const auto active = ActiveContacts(phase);
  const std::vector<ContactSurface> seen = PhaseContacts(phase);
  constraints.push_back(
      std::make_unique<DynamicsConstraint>(model, contacts, active, layout, force_size(), effort_size()));
  for (const ActiveContact& contact : active) {
    if (at_node) {
      constraints.push_back(std::make_unique<RollingAccelerationConstraint>(model, seen, contact.contact, layout));
    } else {
      constraints.push_back(std::make_unique<RollingVelocityConstraint>(model, seen, contact.contact, layout));
    }
    if (contact.directions.size() < 2) continue;  // pushes only; the bound on its force is its limit
    constraints.push_back(std::make_unique<FrictionConstraint>(contacts[contact.contact].name, contact, layout,
                                                               friction_coefficient, force_size()));
  }
  // At a node that belongs to the interval before as well, gaps and distances are bounded there.
  for (int c = 0; !at_node && c < static_cast<int>(contacts.size()); ++c) {
    if (Contains(phases[phase].active, c)) continue;
    constraints.push_back(std::make_unique<GapConstraint>(model, contacts, c, layout, GapConstraint::Kind::kClearance,
                                                          swing_clearance));
  }
  for (size_t s = 0; !at_node && s < separated.size(); ++s) {
    const BodyPair& pair = pairs[separated[s].pair];
    constraints.push_back(std::make_unique<SeparationConstraint>(model, bodies[pair.first], bodies[pair.second], layout,
                                                                 separated[s].clearance));
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
  for (const ActiveContact& contact : active) {
    if (contact.directions.size() < 2) continue;
    constraints.push_back(std::make_unique<FrictionConstraint>(contacts[contact.contact].name, contact, layout,
                                                               friction_coefficient, impulse_size()));
  }
  return constraints;
}

}  // namespace rollgait
