#include "server/convert/gait_events_convert.h"

#include "core/base/check.h"

namespace rollgait::server {
namespace {

v1::Foot EncodeFoot(Foot foot) { return foot == Foot::kRight ? v1::FOOT_RIGHT : v1::FOOT_LEFT; }

v1::GaitEvent::Kind EncodeKind(GaitEventKind kind) {
  switch (kind) {
    case GaitEventKind::kHeelStrike:
      return v1::GaitEvent::KIND_HEEL_STRIKE;
    case GaitEventKind::kFootFlat:
      return v1::GaitEvent::KIND_FOOT_FLAT;
    case GaitEventKind::kHeelOff:
      return v1::GaitEvent::KIND_HEEL_OFF;
    case GaitEventKind::kToeOff:
      return v1::GaitEvent::KIND_TOE_OFF;
  }
  ROLLGAIT_CHECK(false);
}

// One column an instant becomes one row an instant; column-major in, row-major out, so the numbers keep their order.
void EncodeInstants(const MatrixX& columns, v1::Matrix* matrix) {
  matrix->set_rows(static_cast<int>(columns.cols()));
  matrix->set_columns(static_cast<int>(columns.rows()));
  matrix->mutable_values()->Add(columns.data(), columns.data() + columns.size());
}

void EncodeNames(const std::vector<int>& contacts, const Scene& scene,
                 google::protobuf::RepeatedPtrField<std::string>* names) {
  for (const int contact : contacts) *names->Add() = scene.contacts[contact].name;
}

}  // namespace

v1::GaitEvents EncodeGaitEvents(const GaitEvents& events, const Scene& scene) {
  v1::GaitEvents encoded;
  encoded.set_start_s(events.start);
  encoded.set_duration_s(events.duration);
  encoded.set_displacement_m(events.displacement);
  encoded.set_body_weight_n(events.body_weight);
  for (const GaitEvent& event : events.events) {
    v1::GaitEvent* const added = encoded.add_events();
    added->set_kind(EncodeKind(event.kind));
    added->set_foot(EncodeFoot(event.foot));
    added->set_percent(event.percent);
  }
  for (const GaitCycle::Span& span : events.spans) {
    v1::SupportPhase* const phase = encoded.add_phases();
    phase->set_start_percent(span.begin);
    phase->set_end_percent(span.end);
    EncodeNames(span.contacts, scene, phase->mutable_contacts());
    if (span.right) phase->add_feet(v1::FOOT_RIGHT);
    if (span.left) phase->add_feet(v1::FOOT_LEFT);
  }
  for (const Foot which : {Foot::kRight, Foot::kLeft}) {
    const FootOnGround& foot = events.foot(which);
    v1::FootOnGround* const added = encoded.add_feet();
    added->set_foot(EncodeFoot(which));
    EncodeNames(foot.contacts, scene, added->mutable_contacts());
    added->set_stance_fraction(foot.stance);
    added->set_step_length_m(foot.step_length);
    added->set_step_duration_s(foot.step_duration);
    added->set_loading_fraction(foot.loading);
    EncodeInstants(foot.force, added->mutable_force_n());
    EncodeInstants(foot.level_force, added->mutable_level_force_n());
    EncodeInstants(foot.center_of_pressure, added->mutable_center_of_pressure_m());
  }
  encoded.set_double_support_fraction(events.double_support);
  encoded.set_single_support_fraction(events.single_support);
  encoded.set_flight_fraction(events.flight);
  encoded.set_step_length_asymmetry(events.StepLengthAsymmetry());
  encoded.set_step_duration_asymmetry(events.StepDurationAsymmetry());
  encoded.set_stance_asymmetry(events.StanceAsymmetry());
  return encoded;
}

}  // namespace rollgait::server
