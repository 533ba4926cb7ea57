#include "client/report/motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "client/failure.h"

namespace rollgait::client {
namespace {

void Require(bool condition, const std::string& what) {
  if (!condition) throw Failure(ExitCode::kUsage, "the trajectory does not fit its model: " + what);
}

std::vector<int> Columns(const google::protobuf::RepeatedPtrField<std::string>& names, const v1::Model& model,
                         const std::string& field) {
  std::vector<int> columns;
  for (const std::string& name : names) {
    const auto joint = std::find_if(model.joints().begin(), model.joints().end(),
                                    [&name](const v1::Joint& candidate) { return candidate.name() == name; });
    Require(joint != model.joints().end(), field + " has \"" + name + "\", which is not a joint of the model");
    columns.push_back(static_cast<int>(joint - model.joints().begin()));
  }
  return columns;
}

int ContactIndex(const v1::Model& model, const std::string& name) {
  for (int i = 0; i < model.contacts_size(); ++i) {
    if (model.contacts(i).name() == name) return i;
  }
  throw Failure(ExitCode::kUsage, "the trajectory does not fit its model: no contact is called \"" + name + "\"");
}

void RequireShape(const v1::Matrix& matrix, int rows, int columns, const std::string& field) {
  Require(matrix.rows() == rows && matrix.columns() == columns && matrix.values_size() == rows * columns,
          field + " must be " + std::to_string(rows) + " × " + std::to_string(columns) + ", is " +
              std::to_string(matrix.rows()) + " × " + std::to_string(matrix.columns()) + " with " +
              std::to_string(matrix.values_size()) + " values");
}

double Polynomial(const std::vector<double>& coefficients, double theta) {
  double value = 0;
  for (size_t j = coefficients.size(); j-- > 0;) value = value * theta + coefficients[j];
  return value;
}

}  // namespace

std::vector<std::vector<double>> LagrangeCoefficients(const std::vector<double>& nodes) {
  std::vector<std::vector<double>> rows;
  for (size_t i = 0; i < nodes.size(); ++i) {
    std::vector<double> row(nodes.size(), 0.0);
    row[0] = 1.0;
    for (size_t k = 0; k < nodes.size(); ++k) {
      if (k == i) continue;
      for (size_t j = nodes.size(); j-- > 0;) {
        row[j] = ((j > 0 ? row[j - 1] : 0.0) - nodes[k] * row[j]) / (nodes[i] - nodes[k]);
      }
    }
    rows.push_back(row);
  }
  return rows;
}

Motion::Motion(const v1::Trajectory& trajectory, const v1::Model& model)
    : duration_s_(trajectory.duration_s()),
      displacement_m_(trajectory.displacement_m()),
      joints_(Columns(trajectory.joint_names(), model, "joint_names")),
      actuated_(Columns(trajectory.actuated_joint_names(), model, "actuated_joint_names")) {
  Require(trajectory.phases_size() > 0, "phases is empty");
  Require(duration_s_ > 0, "duration_s must be > 0");
  Require(trajectory.points_per_interval() > 0, "points_per_interval must be > 0");
  Require(static_cast<int>(joints_.size()) == model.joints_size(), "joint_names must name every joint of the model");
  for (int i = 0; i < trajectory.phases_size(); ++i) {
    const v1::TrajectoryPhase& phase = trajectory.phases(i);
    PhaseSpan span{phase.start_s(), phase.start_s() + phase.duration_s(), {}};
    for (const std::string& contact : phase.contacts()) span.contacts.push_back(ContactIndex(model, contact));
    phases_.push_back(ReadPhase(trajectory, i, model));
    std::sort(span.contacts.begin(), span.contacts.end());
    phase_spans_.push_back(span);
  }
}

Motion::Phase Motion::ReadPhase(const v1::Trajectory& trajectory, int index, const v1::Model& model) const {
  const v1::TrajectoryPhase& data = trajectory.phases(index);
  const std::string path = "phases[" + std::to_string(index) + "].";
  const int s = trajectory.points_per_interval();
  const int nodes = data.node_times_s_size();
  const int nq = static_cast<int>(joints_.size());
  const int nu = static_cast<int>(actuated_.size());
  Require(nodes >= 2, path + "node_times_s must have at least 2 values");
  const int points = (nodes - 1) * s;
  Require(data.point_times_s_size() == points, path + "point_times_s must have " + std::to_string(points) + " values");
  RequireShape(data.node_positions(), nodes, nq, path + "node_positions");
  RequireShape(data.node_velocities(), nodes, nq, path + "node_velocities");
  RequireShape(data.point_accelerations(), points, nq, path + "point_accelerations");
  RequireShape(data.point_efforts(), points, nu, path + "point_efforts");
  RequireShape(data.point_forces(), points, 3 * data.contacts_size(), path + "point_forces");

  Phase phase;
  phase.active.assign(model.contacts_size(), false);
  for (const std::string& contact : data.contacts()) phase.active[ContactIndex(model, contact)] = true;
  for (int k = 0; k + 1 < nodes; ++k) {
    Interval interval;
    interval.start_s = data.node_times_s(k);
    interval.length_s = data.node_times_s(k + 1) - interval.start_s;
    Require(interval.length_s > 0, path + "node_times_s must increase");
    std::vector<double> fractions;
    for (int i = 0; i < s; ++i) {
      fractions.push_back((data.point_times_s(k * s + i) - interval.start_s) / interval.length_s);
      Require(i == 0 || fractions[i] > fractions[i - 1], path + "point_times_s must increase inside an interval");
    }
    const auto lagrange = LagrangeCoefficients(fractions);
    const auto fit = [&](const v1::Matrix& matrix, int column) {
      std::vector<double> coefficients(s, 0.0);
      for (int i = 0; i < s; ++i) {
        const double value = matrix.values((k * s + i) * matrix.columns() + column);
        for (int j = 0; j < s; ++j) coefficients[j] += value * lagrange[i][j];
      }
      return coefficients;
    };
    interval.position.resize(nq);
    interval.velocity.resize(nq);
    interval.acceleration.resize(nq);
    interval.effort.resize(nq);
    interval.force.resize(model.contacts_size());
    for (int j = 0; j < nq; ++j) {
      interval.position[joints_[j]] = data.node_positions().values(k * nq + j);
      interval.velocity[joints_[j]] = data.node_velocities().values(k * nq + j);
      interval.acceleration[joints_[j]] = fit(data.point_accelerations(), j);
    }
    for (int j = 0; j < nu; ++j) interval.effort[actuated_[j]] = fit(data.point_efforts(), j);
    for (int c = 0; c < data.contacts_size(); ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        interval.force[ContactIndex(model, data.contacts(c))][axis] = fit(data.point_forces(), 3 * c + axis);
      }
    }
    phase.intervals.push_back(std::move(interval));
  }
  return phase;
}

Instant Motion::At(double time_s, bool from_left) const {
  time_s = std::clamp(time_s, 0.0, duration_s_);
  // A border is met with the rounding of sums of durations in mind.
  const double slack = (from_left ? -1e-12 : 1e-12) * duration_s_;
  size_t p = 0;
  while (p + 1 < phases_.size() && time_s + slack >= phase_spans_[p + 1].start_s) ++p;
  const Phase& phase = phases_[p];
  size_t k = 0;
  while (k + 1 < phase.intervals.size() && time_s >= phase.intervals[k + 1].start_s) ++k;
  const Interval& interval = phase.intervals[k];
  const double h = interval.length_s;
  const double theta = std::clamp((time_s - interval.start_s) / h, 0.0, 1.0);

  Instant instant;
  const size_t nq = interval.position.size();
  instant.active = phase.active;
  instant.position = interval.position;
  instant.velocity = interval.velocity;
  instant.effort.resize(nq);
  instant.force.resize(interval.force.size());
  for (size_t i = 0; i < nq; ++i) {
    // v = v0 + h Σ a_j θ^(j+1)/(j+1),  q = q0 + h θ v0 + h² Σ a_j θ^(j+2)/((j+1)(j+2)).
    instant.position[i] += h * theta * interval.velocity[i];
    for (size_t j = 0; j < interval.acceleration[i].size(); ++j) {
      const double n = static_cast<double>(j);
      const double term = interval.acceleration[i][j] * std::pow(theta, n + 1) / (n + 1);
      instant.velocity[i] += h * term;
      instant.position[i] += h * h * theta * term / (n + 2);
    }
    instant.effort[i] = Polynomial(interval.effort[i], theta);
  }
  for (size_t c = 0; c < interval.force.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) instant.force[c][axis] = Polynomial(interval.force[c][axis], theta);
  }
  return instant;
}

}  // namespace rollgait::client
