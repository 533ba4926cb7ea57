#include <cmath>

#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

void SetShape(v1::Matrix* matrix, int columns) {
  matrix->set_rows(201);
  matrix->set_columns(columns);
}

// The right foot takes over the weight in the first tenth of the cycle and gives it back between 50 and 60 %; the left
// foot does so half a cycle later. The centre of pressure goes forward by 0.2 m through stance.
void FillFoot(const v1::Model& model, v1::Foot side, v1::FootOnGround& foot) {
  foot.set_foot(side);
  foot.add_contacts(side == v1::FOOT_RIGHT ? "right_foot" : "left_foot");
  foot.set_stance_fraction(0.6);
  const double weight = model.total_mass_kg() * model.gravity_m_s2();
  SetShape(foot.mutable_force_n(), 3);
  SetShape(foot.mutable_level_force_n(), 3);
  SetShape(foot.mutable_center_of_pressure_m(), 2);
  for (int i = 0; i <= 200; ++i) {
    const double percent = std::fmod(0.5 * i + (side == v1::FOOT_RIGHT ? 0 : 50), 100);
    const double share = percent < 10 ? percent / 10 : percent < 50 ? 1 : percent < 60 ? 6 - percent / 10 : 0;
    const double normal = weight * share, angle = 2 * M_PI * std::fmod(percent, 50) / 100;
    for (const double force : {-0.15 * normal * std::cos(angle), 0.0, normal}) {
      foot.mutable_force_n()->add_values(force);
      foot.mutable_level_force_n()->add_values(force);
    }
    foot.mutable_center_of_pressure_m()->add_values(share >= 0.01 ? 0.3 + 0.2 * percent / 60 : NAN);
    foot.mutable_center_of_pressure_m()->add_values(share >= 0.01 ? 0 : NAN);
  }
}

}  // namespace

v1::GaitEvents SampleGaitEvents(const v1::Model& model) {
  v1::GaitEvents events;
  events.set_start_s(kSampleSpan_s);
  events.set_duration_s(2 * kSampleSpan_s);
  events.set_displacement_m(2 * kSampleDisplacement_m);
  events.set_body_weight_n(model.total_mass_kg() * model.gravity_m_s2());
  const auto event = [&events](v1::GaitEvent::Kind kind, v1::Foot foot, double percent) {
    v1::GaitEvent& added = *events.add_events();
    added.set_kind(kind);
    added.set_foot(foot);
    added.set_percent(percent);
  };
  event(v1::GaitEvent::KIND_HEEL_STRIKE, v1::FOOT_RIGHT, 0);
  event(v1::GaitEvent::KIND_TOE_OFF, v1::FOOT_LEFT, 10);
  event(v1::GaitEvent::KIND_HEEL_STRIKE, v1::FOOT_LEFT, 50);
  event(v1::GaitEvent::KIND_TOE_OFF, v1::FOOT_RIGHT, 60);
  const double borders[] = {0, 10, 50, 60, 100};
  for (int i = 0; i < 4; ++i) {
    v1::SupportPhase& phase = *events.add_phases();
    phase.set_start_percent(borders[i]);
    phase.set_end_percent(borders[i + 1]);
    const bool left = i != 1, right = i != 3;
    if (left) phase.add_contacts("left_foot");
    if (right) phase.add_contacts("right_foot");
    if (right) phase.add_feet(v1::FOOT_RIGHT);
    if (left) phase.add_feet(v1::FOOT_LEFT);
  }
  FillFoot(model, v1::FOOT_RIGHT, *events.add_feet());
  FillFoot(model, v1::FOOT_LEFT, *events.add_feet());
  events.set_double_support_fraction(0.2);
  events.set_single_support_fraction(0.8);
  return events;
}

}  // namespace rollgait::client
