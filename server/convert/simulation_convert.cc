// Results of a simulation as messages.
#include <algorithm>
#include <cmath>

#include "server/convert/scene_convert.h"

namespace rollgait::server {
namespace {

void EncodeVector(const Vector3& v, v1::Vector3* encoded) {
  encoded->set_x(v.x());
  encoded->set_y(v.y());
  encoded->set_z(v.z());
}

void EncodeNumbers(const VectorX& values, google::protobuf::RepeatedField<double>* encoded) {
  encoded->Reserve(static_cast<int>(values.size()));
  for (const double value : values) encoded->Add(value);
}

const std::string& ContactName(const SimulationScene& scene, int k) {
  return scene.contacts[static_cast<size_t>(k)].contact.name;
}

v1::SimulationEvent::Kind EncodeKind(SimulationEventKind kind) {
  switch (kind) {
    case SimulationEventKind::kTouchDown:
      return v1::SimulationEvent::KIND_TOUCH_DOWN;
    case SimulationEventKind::kLiftOff:
      return v1::SimulationEvent::KIND_LIFT_OFF;
    case SimulationEventKind::kFrictionLoss:
      return v1::SimulationEvent::KIND_FRICTION_LOST;
    case SimulationEventKind::kFrictionRegained:
      return v1::SimulationEvent::KIND_FRICTION_REGAINED;
    case SimulationEventKind::kStick:
      return v1::SimulationEvent::KIND_STUCK;
  }
  ROLLGAIT_CHECK(false);
}

v1::SimulationReport::End EncodeEnd(SimulationEnd end) {
  switch (end) {
    case SimulationEnd::kDuration:
      return v1::SimulationReport::END_DURATION;
    case SimulationEnd::kImpactCount:
      return v1::SimulationReport::END_IMPACT_COUNT;
    case SimulationEnd::kFrictionLoss:
      return v1::SimulationReport::END_FRICTION_LOST;
    case SimulationEnd::kStopped:
      return v1::SimulationReport::END_STOPPED;
    case SimulationEnd::kStepTooSmall:
      return v1::SimulationReport::END_STEP_TOO_SMALL;
    case SimulationEnd::kNotFinite:
      return v1::SimulationReport::END_NOT_FINITE;
    case SimulationEnd::kTooManySteps:
      return v1::SimulationReport::END_TOO_MANY_STEPS;
    case SimulationEnd::kTooManyEvents:
      return v1::SimulationReport::END_TOO_MANY_EVENTS;
    case SimulationEnd::kFrictionUndetermined:
      return v1::SimulationReport::END_FRICTION_UNDETERMINED;
    case SimulationEnd::kRollingImpossible:
      return v1::SimulationReport::END_ROLLING_IMPOSSIBLE;
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace

v1::SimulationSample EncodeSample(const SimulationSample& sample) {
  v1::SimulationSample encoded;
  encoded.set_time_s(sample.time);
  EncodeNumbers(sample.q, encoded.mutable_positions());
  EncodeNumbers(sample.v, encoded.mutable_velocities());
  EncodeNumbers(sample.acceleration, encoded.mutable_accelerations());
  for (const ContactSample& contact : sample.contacts) {
    v1::ContactSample* c = encoded.add_contacts();
    c->set_active(contact.active);
    c->set_sliding(contact.sliding);
    c->set_gap_m(contact.gap);
    EncodeVector(contact.point, c->mutable_point_m());
    EncodeVector(contact.normal, c->mutable_normal());
    EncodeVector(contact.slip, c->mutable_slip_m_s());
    EncodeVector(contact.force, c->mutable_force_n());
    c->set_spin_torque_n_m(contact.spin_torque);
    c->set_friction_ratio(contact.friction_ratio);
  }
  encoded.set_kinetic_energy_j(sample.kinetic_energy);
  encoded.set_potential_energy_j(sample.potential_energy);
  encoded.set_work_j(sample.work);
  return encoded;
}

v1::SimulationEvent EncodeEvent(const SimulationEvent& event, const SimulationScene& scene) {
  v1::SimulationEvent encoded;
  encoded.set_kind(EncodeKind(event.kind));
  encoded.set_time_s(event.time);
  encoded.set_contact(ContactName(scene, event.contact));
  EncodeNumbers(event.q, encoded.mutable_positions());
  EncodeNumbers(event.velocity_before, encoded.mutable_velocities_before());
  EncodeNumbers(event.velocity_after, encoded.mutable_velocities_after());
  for (size_t k = 0; k < event.impulses.size(); ++k) {
    const auto released = std::find(event.released.begin(), event.released.end(), static_cast<int>(k));
    if (event.impulses[k].isZero(0) && released == event.released.end()) continue;
    v1::SimulationEvent::Impulse* impulse = encoded.add_impulses();
    impulse->set_contact(ContactName(scene, static_cast<int>(k)));
    EncodeVector(event.impulses[k], impulse->mutable_impulse_n_s());
    if (released == event.released.end()) continue;
    impulse->set_released(true);
    const auto index = static_cast<size_t>(released - event.released.begin());
    impulse->set_gap_rate_after_m_s(event.released_gap_rates[index]);
  }
  encoded.set_energy_loss_j(event.energy_loss);
  encoded.set_redundant(event.redundant);
  encoded.set_consistent(event.consistent);
  return encoded;
}

v1::SimulationReport EncodeReport(const SimulationReport& report, const SimulationScene& scene) {
  v1::SimulationReport encoded;
  encoded.set_end(EncodeEnd(report.end));
  encoded.set_end_time_s(report.end_time);
  encoded.set_steps(report.steps);
  encoded.set_rejected_steps(report.rejected_steps);
  encoded.set_evaluations(report.evaluations);
  encoded.set_impacts(report.impacts);
  encoded.set_energy_initial_j(report.energy_initial);
  encoded.set_energy_final_j(report.energy_final);
  encoded.set_max_energy_error_j(report.max_energy_error);
  encoded.set_max_gap_m(report.max_gap);
  encoded.set_max_slip_m_s(report.max_slip);
  encoded.set_max_quaternion_error(report.max_quaternion_error);
  if (report.min_normal_force_contact >= 0) {
    encoded.set_min_normal_force_n(report.min_normal_force);
    encoded.set_min_normal_force_time_s(report.min_normal_force_time);
    encoded.set_min_normal_force_contact(ContactName(scene, report.min_normal_force_contact));
  }
  if (report.max_friction_ratio_contact >= 0) {
    encoded.set_max_friction_ratio(report.max_friction_ratio);
    encoded.set_max_friction_ratio_time_s(report.max_friction_ratio_time);
    encoded.set_max_friction_ratio_contact(ContactName(scene, report.max_friction_ratio_contact));
  }
  encoded.set_redundant(report.redundant);
  for (const int k : report.active_at_end) encoded.add_active_at_end(ContactName(scene, k));
  return encoded;
}

v1::PeriodicGait EncodeGait(const PeriodicGait& gait, const SimulationScene& scene) {
  v1::PeriodicGait encoded;
  encoded.set_converged(gait.converged);
  encoded.set_iterations(gait.iterations);
  encoded.set_residual(gait.residual);
  EncodeNumbers(gait.q, encoded.mutable_positions());
  EncodeNumbers(gait.v, encoded.mutable_velocities());
  encoded.set_period_s(gait.period);
  encoded.set_step_length_m(gait.step_length);
  double largest = 0;
  for (const auto& eigenvalue : gait.eigenvalues) {
    v1::PeriodicGait::Complex* complex = encoded.add_eigenvalues();
    complex->set_re(eigenvalue.real());
    complex->set_im(eigenvalue.imag());
    largest = std::max(largest, std::abs(eigenvalue));
  }
  encoded.set_stable(gait.converged && largest < 1);
  if (gait.period > 0) *encoded.mutable_heel_strike() = EncodeEvent(gait.heel_strike, scene);
  if (gait.period > 0) *encoded.mutable_report() = EncodeReport(gait.report, scene);
  return encoded;
}

}  // namespace rollgait::server
