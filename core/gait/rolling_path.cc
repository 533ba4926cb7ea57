#include "core/gait/rolling_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

constexpr int kInstants = 201;
constexpr double kPi = std::numbers::pi;

Matrix3 Exp(const Vector3& turn) {
  const double angle = turn.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3::Identity();
}

// Of least angle, rad.
Vector3 Log(const Matrix3& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

// 0 … 1 with rest at both ends.
double Smooth(double t) { return t * t * (3 - 2 * t); }

Eigen::Vector2d Place(const Manoeuvre& manoeuvre, const Detour& detour, double s) {
  const Eigen::Vector2d from(*manoeuvre.start.x, *manoeuvre.start.y);
  const Eigen::Vector2d to(manoeuvre.end.x.value_or(from.x()), manoeuvre.end.y.value_or(from.y()));
  const Eigen::Vector2d out(std::cos(detour.direction), std::sin(detour.direction)), side(-out.y(), out.x());
  const Eigen::Vector2d loop = (1 - std::cos(2 * kPi * s)) * out + detour.sense * std::sin(2 * kPi * s) * side;
  return from + s * (to - from) + detour.size * loop;
}

// Directions spread evenly over the half-sphere z >= 0 (a Fibonacci lattice).
std::vector<Vector3> Directions() {
  constexpr int kCount = 120;
  std::vector<Vector3> directions;
  for (int i = 0; i < kCount; ++i) {
    const double z = (i + 0.5) / kCount, across = std::sqrt(1 - z * z), angle = i * kPi * (3 - std::sqrt(5.0));
    directions.emplace_back(across * std::cos(angle), across * std::sin(angle), z);
  }
  return directions;
}

// Largest |axis · directions|, given up above `most`.
double Largest(const Vector3& axis, const std::vector<Vector3>& directions, double most) {
  double largest = 0;
  for (const Vector3& direction : directions) {
    largest = std::max(largest, std::abs(axis.dot(direction)));
    if (largest > most) break;
  }
  return largest;
}

// The chart with first axis `world` and last axis `body` whose first and last angle are zero at rotation R.
OrientationChart ChartThrough(const Vector3& world, const Vector3& body, const Matrix3& R) {
  const Vector3 last = R * body;
  const Vector3 z = (last - world.dot(last) * world).normalized();
  OrientationChart chart;
  chart.world << world, z.cross(world), z;
  const double beta = std::asin(std::clamp(world.dot(last), -1.0, 1.0));
  chart.body = Eigen::AngleAxisd(-beta, Vector3::UnitY()).toRotationMatrix() * chart.world.transpose() * R;
  // To full precision a rotation, whatever `body` is to.
  chart.body = Eigen::Quaterniond(chart.body).normalized().toRotationMatrix();
  chart.world = Eigen::Quaterniond(chart.world).normalized().toRotationMatrix();
  return chart;
}

void Interpolate(const MatrixX& columns, double fraction, VectorX* value) {
  const double place = fraction * static_cast<double>(columns.cols() - 1);
  const auto before = std::min(static_cast<Eigen::Index>(place), columns.cols() - 2);
  const double share = place - static_cast<double>(before);
  *value = (1 - share) * columns.col(before) + share * columns.col(before + 1);
}

MatrixX Differences(const MatrixX& columns, double step) {
  const Eigen::Index last = columns.cols() - 1;
  MatrixX slopes(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k <= last; ++k) {
    const Eigen::Index a = std::max<Eigen::Index>(k - 1, 0), b = std::min(k + 1, last);
    slopes.col(k) = (columns.col(b) - columns.col(a)) / (step * static_cast<double>(b - a));
  }
  return slopes;
}

}  // namespace

RollingPath SketchPath(const GaitSpec& spec, const Detour& detour, double duration) {
  const Manoeuvre& manoeuvre = *spec.manoeuvre;
  const Surface& surface = spec.scene.contacts.front().surface;
  const double radius = spec.scene.selection.rolling_body->semi_axes.mean();
  RollingPath path;
  path.duration = duration;
  path.couples.assign(kInstants, Vector3::Zero());
  path.forces.assign(kInstants, -spec.scene.model.total_mass() * spec.gravity);
  std::vector<Eigen::Vector2d> places;
  std::vector<Matrix3> rolled = {manoeuvre.start.orientation->toRotationMatrix()};
  for (int k = 0; k < kInstants; ++k) {
    places.push_back(Place(manoeuvre, detour, Smooth(k / (kInstants - 1.0))));
    if (k == 0) continue;
    const Eigen::Vector2d step = places[k] - places[k - 1];
    rolled.push_back(Exp(Vector3(-step.y(), step.x(), 0) / radius) * rolled.back());
  }
  Vector3 missing = Vector3::Zero();
  if (manoeuvre.end.orientation)
    missing = Log(manoeuvre.end.orientation->toRotationMatrix() * rolled.back().transpose());
  const double angle = missing.norm();
  if (detour.long_way && angle > 0) missing *= 1 - 2 * kPi / angle;
  for (int k = 0; k < kInstants; ++k) {
    const Matrix3 R = Exp(Smooth(k / (kInstants - 1.0)) * missing) * rolled[k];
    const double height = surface.Support(-R.row(2).transpose());
    path.rotations.push_back(R);
    path.positions.emplace_back(places[k].x(), places[k].y(), height);
  }
  return path;
}

RollingPath PathOf(const Scene& scene, const Trajectory& trajectory) {
  const OrientationChart chart = ChartOf(scene);
  const TrajectoryPhase& phase = trajectory.phases.front();
  RollingPath path;
  path.duration = phase.duration;
  int interval = 0;
  for (int i = 0; i < kInstants; ++i) {
    const double time = phase.start + phase.duration * i / (kInstants - 1);
    const int last = static_cast<int>(phase.node_times.size()) - 2;
    while (interval < last && phase.node_times[interval + 1] <= time) ++interval;
    const double length = phase.node_times[interval + 1] - phase.node_times[interval];
    const MotionSample at =
        Sample(trajectory, 0, interval, std::min(1.0, (time - phase.node_times[interval]) / length));
    const Vector3 angles = at.position.tail<3>();
    path.positions.push_back(at.position.head<3>());
    path.rotations.push_back(ChartRotation(chart, angles));
    path.couples.push_back(ChartRates(chart, angles).transpose().inverse() * at.efforts);
    path.forces.push_back(at.forces);
  }
  return path;
}

std::optional<OrientationChart> ChooseChart(const RollingPath& path) {
  const std::vector<Vector3> directions = Directions();
  double least = std::sin(OrientationChart::kLargestTilt - 0.02);
  std::optional<OrientationChart> best;
  for (const Vector3& body : directions) {
    std::vector<Vector3> turned;
    for (size_t k = 0; k < path.rotations.size(); k += 4) turned.push_back(path.rotations[k] * body);
    for (const Vector3& world : directions) {
      const double largest = Largest(world, turned, least);
      if (largest >= least) continue;
      least = largest;
      best = ChartThrough(world, body, path.rotations.front());
    }
  }
  return best;
}

MatrixX ChartPositions(const RollingPath& path, const OrientationChart& chart) {
  const int count = static_cast<int>(path.positions.size());
  MatrixX positions(6, count);
  for (int k = 0; k < count; ++k) {
    positions.col(k) << path.positions[k], ChartAngles(chart, path.rotations[k]);
    for (int j = 3; k > 0 && j < 6; ++j) {
      positions(j, k) -= 2 * kPi * std::round((positions(j, k) - positions(j, k - 1)) / (2 * kPi));
    }
  }
  return positions;
}

MotionGuess GuessInChart(const RollingPath& path, const OrientationChart& chart) {
  struct Table {
    MatrixX position, velocity, acceleration, efforts, forces;
  };
  const auto table = std::make_shared<Table>();
  const int count = static_cast<int>(path.positions.size());
  const double step = path.duration / (count - 1);
  table->position = ChartPositions(path, chart);
  table->velocity = Differences(table->position, step);
  table->acceleration = Differences(table->velocity, step);
  table->efforts.resize(3, count);
  table->forces.resize(3, count);
  for (int k = 0; k < count; ++k) {
    table->efforts.col(k) = ChartRates(chart, table->position.col(k).tail<3>()).transpose() * path.couples[k];
    table->forces.col(k) = path.forces[k];
  }
  MotionGuess guess;
  guess.durations = {path.duration};
  guess.displacement = path.positions.back().x() - path.positions.front().x();
  guess.motion = [table](int, double fraction) {
    MotionSample sample;
    Interpolate(table->position, fraction, &sample.position);
    Interpolate(table->velocity, fraction, &sample.velocity);
    Interpolate(table->acceleration, fraction, &sample.acceleration);
    Interpolate(table->efforts, fraction, &sample.efforts);
    Interpolate(table->forces, fraction, &sample.forces);
    return sample;
  };
  return guess;
}

Ends EndsInChart(const Manoeuvre& manoeuvre, const RollingPath& path, const OrientationChart& chart) {
  const MatrixX positions = ChartPositions(path, chart);
  const auto bounds = [&](const BodyState& state, const Vector3& angles) {
    EndBounds bound{VectorX::Constant(12, -kInfinity), VectorX::Constant(12, kInfinity)};
    const auto fix = [&bound](int index, double value) { bound.lower(index) = bound.upper(index) = value; };
    if (state.x) fix(0, *state.x);
    if (state.y) fix(1, *state.y);
    const Vector3 rates = ChartRates(chart, angles).inverse() * state.angular_velocity;
    for (int j = 0; j < 3; ++j) {
      if (state.orientation) fix(3 + j, angles(j));
      fix(9 + j, rates(j));
    }
    return bound;
  };
  return {bounds(manoeuvre.start, positions.col(0).tail<3>()),
          bounds(manoeuvre.end, positions.col(positions.cols() - 1).tail<3>())};
}

}  // namespace rollgait
