#include "core/trajectory/sampling.h"

#include "core/base/check.h"

namespace rollgait {
namespace {

// s × s: column j of  values · result  is the coefficient of θ^j of the polynomial through `values` at the fractions c.
// Row i holds the coefficients of the Lagrange polynomial L_i, built by multiplying out its factors.
MatrixX MonomialCoefficients(const std::vector<double>& c) {
  const int s = static_cast<int>(c.size());
  MatrixX result = MatrixX::Zero(s, s);
  for (int i = 0; i < s; ++i) {
    result(i, 0) = 1;
    int degree = 0;
    for (int k = 0; k < s; ++k) {
      if (k == i) continue;
      ROLLGAIT_CHECK(c[i] != c[k]);
      const double inverse = 1 / (c[i] - c[k]);
      ++degree;
      for (int j = degree; j >= 0; --j) {
        result(i, j) = ((j > 0 ? result(i, j - 1) : 0.0) - c[k] * result(i, j)) * inverse;
      }
    }
  }
  return result;
}

// Σ column_j θ^j by Horner's rule.
void Horner(const MatrixX& coefficients, double theta, VectorX* value) {
  *value = coefficients.col(coefficients.cols() - 1);
  for (int j = static_cast<int>(coefficients.cols()) - 2; j >= 0; --j) {
    *value *= theta;
    *value += coefficients.col(j);
  }
}

// The points of one interval; a matrix without rows (free flight, no actuators) may lack columns too.
MatrixX BlockOf(const MatrixX& points, int interval, int s) {
  if (points.rows() == 0) return MatrixX::Zero(0, s);
  ROLLGAIT_CHECK(points.cols() >= (interval + 1) * s);
  return points.middleCols(interval * s, s);
}

std::span<const double> RowOf(const MatrixX& coefficients, int row, std::span<double> room) {
  const int s = static_cast<int>(coefficients.cols());
  ROLLGAIT_CHECK(static_cast<int>(room.size()) >= s);
  for (int j = 0; j < s; ++j) room[j] = coefficients(row, j);
  return room.first(s);
}

}  // namespace

IntervalPolynomials::IntervalPolynomials(const Trajectory& trajectory, int phase, int interval) {
  ROLLGAIT_CHECK(phase >= 0 && phase < static_cast<int>(trajectory.phases.size()));
  const TrajectoryPhase& data = trajectory.phases[phase];
  ROLLGAIT_CHECK(interval >= 0 && interval + 1 < static_cast<int>(data.node_times.size()));
  const int s = trajectory.points_per_interval;
  ROLLGAIT_CHECK(s >= 1 && static_cast<int>(trajectory.point_fractions.size()) == s);
  start_ = data.node_times[interval];
  length_ = data.node_times[interval + 1] - start_;
  position_ = data.node_positions.col(interval);
  velocity_ = data.node_velocities.col(interval);
  const MatrixX monomials = MonomialCoefficients(trajectory.point_fractions);
  acceleration_ = BlockOf(data.point_accelerations, interval, s) * monomials;
  efforts_ = BlockOf(data.point_efforts, interval, s) * monomials;
  forces_ = BlockOf(data.point_forces, interval, s) * monomials;
}

void IntervalPolynomials::Evaluate(double theta, MotionSample* sample) const {
  const double h = length_;
  Horner(acceleration_, theta, &sample->acceleration);
  Horner(efforts_, theta, &sample->efforts);
  Horner(forces_, theta, &sample->forces);
  // v = v₀ + h Σ a_j θ^(j+1)/(j+1),  q = q₀ + h θ v₀ + h² Σ a_j θ^(j+2)/((j+1)(j+2)).
  sample->velocity = velocity_;
  sample->position = position_;
  sample->position += (h * theta) * velocity_;
  double power = theta;
  for (int j = 0; j < acceleration_.cols(); ++j, power *= theta) {
    sample->velocity += (h * power / (j + 1)) * acceleration_.col(j);
    sample->position += (h * h * power * theta / ((j + 1) * (j + 2))) * acceleration_.col(j);
  }
}

void IntervalPolynomials::EvaluateEfforts(double theta, VectorX* efforts) const { Horner(efforts_, theta, efforts); }

std::span<const double> IntervalPolynomials::PositionPolynomial(int row, std::span<double> room) const {
  const int s = static_cast<int>(acceleration_.cols());
  ROLLGAIT_CHECK(static_cast<int>(room.size()) >= s + 2);
  room[0] = position_[row];
  room[1] = length_ * velocity_[row];
  for (int j = 0; j < s; ++j) room[j + 2] = length_ * length_ / ((j + 1) * (j + 2)) * acceleration_(row, j);
  return room.first(s + 2);
}

std::span<const double> IntervalPolynomials::VelocityPolynomial(int row, std::span<double> room) const {
  const int s = static_cast<int>(acceleration_.cols());
  ROLLGAIT_CHECK(static_cast<int>(room.size()) >= s + 1);
  room[0] = velocity_[row];
  for (int j = 0; j < s; ++j) room[j + 1] = length_ / (j + 1) * acceleration_(row, j);
  return room.first(s + 1);
}

std::span<const double> IntervalPolynomials::EffortPolynomial(int row, std::span<double> room) const {
  return RowOf(efforts_, row, room);
}

std::span<const double> IntervalPolynomials::ForcePolynomial(int row, std::span<double> room) const {
  return RowOf(forces_, row, room);
}

MotionSample Sample(const Trajectory& trajectory, int phase, int interval, double theta) {
  MotionSample sample;
  IntervalPolynomials(trajectory, phase, interval).Evaluate(theta, &sample);
  return sample;
}

void FillPointStates(Trajectory* trajectory) {
  const int s = trajectory->points_per_interval;
  MotionSample sample;
  for (int p = 0; p < static_cast<int>(trajectory->phases.size()); ++p) {
    TrajectoryPhase& phase = trajectory->phases[p];
    const int intervals = static_cast<int>(phase.node_times.size()) - 1;
    phase.point_positions.resize(phase.node_positions.rows(), intervals * s);
    phase.point_velocities.resize(phase.node_velocities.rows(), intervals * s);
    for (int k = 0; k < intervals; ++k) {
      const IntervalPolynomials polynomials(*trajectory, p, k);
      for (int i = 0; i < s; ++i) {
        polynomials.Evaluate(trajectory->point_fractions[i], &sample);
        phase.point_positions.col(k * s + i) = sample.position;
        phase.point_velocities.col(k * s + i) = sample.velocity;
      }
    }
  }
}

VectorX SampleEfforts(const Trajectory& trajectory, int phase, int interval, double theta) {
  VectorX efforts;
  IntervalPolynomials(trajectory, phase, interval).EvaluateEfforts(theta, &efforts);
  return efforts;
}

}  // namespace rollgait
