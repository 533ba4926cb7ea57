#include "core/simulation/recording.h"

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

double FrictionRatio(int k, SceneDynamics* dynamics) {
  const double normal = dynamics->contacts().Kinematics(k).normal.dot(dynamics->contacts().Force(k));
  const double tangential = dynamics->TangentialForce(k).norm();
  if (tangential == 0) return 0;
  return normal > 0 ? tangential / normal : kInfinity;
}

ContactSample SampleContact(int k, SceneDynamics* dynamics) {
  const PairKinematics& pair = dynamics->contacts().Kinematics(k);
  ContactSample sample;
  sample.active = dynamics->IsActive(k);
  sample.gap = pair.gap;
  sample.point = pair.p_1;
  sample.normal = pair.normal;
  sample.slip = pair.slip;
  if (!sample.active) return sample;
  sample.sliding = dynamics->IsSliding(k);
  sample.force = dynamics->contacts().Force(k);
  sample.spin_torque = dynamics->contacts().SpinTorque(k);
  sample.friction_ratio = FrictionRatio(k, dynamics);
  return sample;
}

}  // namespace

SimulationSample MakeSample(double time, const VectorX& x, SceneDynamics* dynamics) {
  SimulationSample sample;
  sample.time = time;
  sample.q = dynamics->Positions(x);
  sample.v = dynamics->Velocities(x);
  sample.acceleration = dynamics->solution().acceleration;
  sample.kinetic_energy = dynamics->KineticEnergy();
  sample.potential_energy = dynamics->PotentialEnergy();
  sample.work = x[dynamics->size() - 1];
  for (int k = 0; k < dynamics->contacts().contact_count(); ++k) sample.contacts.push_back(SampleContact(k, dynamics));
  return sample;
}

void RecordExtremes(const SimulationScene& scene, double time, const VectorX& x, SceneDynamics* dynamics,
                    SimulationReport* report) {
  const double energy = dynamics->KineticEnergy() + dynamics->PotentialEnergy();
  report->energy_final = energy;
  const double error = std::abs(energy - x[dynamics->size() - 1] - report->energy_initial);
  report->max_energy_error = std::max(report->max_energy_error, error);
  report->redundant = report->redundant || !dynamics->solution().ForcesUnique();
  ContactDynamics& contacts = dynamics->contacts();
  MatrixX rows;
  VectorX rates;
  for (int k : dynamics->active()) {
    const PairKinematics& pair = contacts.Kinematics(k);
    if (scene.options.drift != DriftControl::kProjection) {
      report->max_gap = std::max(report->max_gap, std::abs(pair.gap));
      contacts.VelocityRows({k}, &rows, &rates);
      report->max_slip = std::max(report->max_slip, rates.cwiseAbs().maxCoeff());
    }
    const double normal = pair.normal.dot(contacts.Force(k)), ratio = FrictionRatio(k, dynamics);
    if (normal < report->min_normal_force) {
      report->min_normal_force = normal;
      report->min_normal_force_time = time;
      report->min_normal_force_contact = k;
    }
    if (ratio > report->max_friction_ratio) {
      report->max_friction_ratio = ratio;
      report->max_friction_ratio_time = time;
      report->max_friction_ratio_contact = k;
    }
  }
}

}  // namespace rollgait
