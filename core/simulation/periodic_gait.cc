#include "core/simulation/periodic_gait.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/math/dense_solve.h"
#include "core/simulation/initial_state.h"

namespace rollgait {
namespace {

constexpr double kFinestTolerance = 1e-13;
constexpr double kRankTolerance = 1e-9;

int MirrorContact(const SimulationScene& scene, int k) {
  const int mirror = scene.contacts[static_cast<size_t>(k)].mirror;
  return mirror < 0 ? k : mirror;
}

VectorX Relabelled(const Model& model, const VectorX& values) {
  VectorX result(values.size());
  for (int i = 0; i < model.size(); ++i) {
    result[i] = model.joint(i).mirror_sign * values[model.joint(i).mirror_joint];
  }
  return result;
}

// One step of the walker as a map of states.
class StepMap {
 public:
  StepMap(const SimulationScene& scene, const StopFlag* stop) : scene_(scene), stop_(stop) {
    scene_.adjusted_joints.clear();
    scene_.options.stop_after_impacts = 1;
    scene_.options.tolerance = std::min(scene_.options.tolerance, kFinestTolerance);
    scene_.options.output_step = scene_.options.duration;
    for (size_t k = 0; k < scene.contacts.size(); ++k) {
      if (scene.contacts[k].active) expected_.push_back(MirrorContact(scene, static_cast<int>(k)));
    }
    std::sort(expected_.begin(), expected_.end());
  }

  // False if the step does not end with a heel strike that hands the weight over.
  bool Map(const VectorX& q, const VectorX& v, VectorX* q_next, VectorX* v_next) {
    scene_.q = q;
    scene_.v = v;
    SimulationObserver observer;
    observer.event = [this](const SimulationEvent& event) {
      if (event.kind == SimulationEventKind::kTouchDown) heel_strike_ = event;
      return true;
    };
    Result<SimulationReport> report = Simulate(scene_, observer, stop_);
    if (!report.ok()) return false;
    report_ = std::move(report).value();
    if (report_.end != SimulationEnd::kImpactCount || report_.active_at_end != expected_) return false;
    *q_next = Relabelled(scene_.model, heel_strike_.q);
    *v_next = Relabelled(scene_.model, heel_strike_.velocity_after);
    return true;
  }

  const SimulationEvent& heel_strike() const { return heel_strike_; }
  const SimulationReport& report() const { return report_; }

 private:
  SimulationScene scene_;
  const StopFlag* stop_;
  std::vector<int> expected_;
  SimulationEvent heel_strike_;
  SimulationReport report_;
};

// y ↦ coordinates of P(state(y)).
bool MapCoordinates(const VectorX& y, GaitSection* section, StepMap* map, VectorX* image) {
  VectorX q, v, q_next, v_next;
  section->State(y, &q, &v);
  if (!map->Map(q, v, &q_next, &v_next)) return false;
  *image = section->Coordinates(q_next, v_next);
  return true;
}

// Central differences of order 6.
bool Differentiate(const VectorX& y, double step, GaitSection* section, StepMap* map, MatrixX* jacobian) {
  constexpr double kWeights[3] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
  const Eigen::Index d = y.size();
  jacobian->setZero(d, d);
  VectorX forward, backward;
  for (Eigen::Index j = 0; j < d; ++j) {
    for (int i = 0; i < 3; ++i) {
      const VectorX shift = VectorX::Unit(d, j) * (step * (i + 1));
      if (!MapCoordinates(y + shift, section, map, &forward)) return false;
      if (!MapCoordinates(y - shift, section, map, &backward)) return false;
      jacobian->col(j) += kWeights[i] / step * (forward - backward);
    }
  }
  return true;
}

Violations CheckWalker(const SimulationScene& scene) {
  Violations violations;
  if (scene.model.HasFreeJoint()) {
    violations.push_back({"joints", "has a free joint; a periodic gait needs joints with one degree of freedom"});
  }
  if (std::none_of(scene.contacts.begin(), scene.contacts.end(), [](const SceneContact& c) { return c.active; })) {
    violations.push_back({"contacts", "has no active contact; make the stance foot active"});
  }
  for (size_t i = 0; i < scene.ground.size(); ++i) {
    if (scene.ground[i].IsFixed()) continue;
    violations.push_back({"ground[" + std::to_string(i) + "]", "moves; a periodic gait needs fixed ground"});
  }
  return violations;
}

}  // namespace

GaitSection::GaitSection(const SimulationScene& scene, const VectorX& q)
    : dynamics_(scene), touching_(dynamics_.active()) {
  for (int k : dynamics_.active()) {
    const int mirror = MirrorContact(scene, k);
    if (std::find(touching_.begin(), touching_.end(), mirror) == touching_.end()) touching_.push_back(mirror);
  }
  std::sort(touching_.begin(), touching_.end());
  VectorX gaps;
  MatrixX rows, without_travel;
  // The normals at the start lead onto the section; those there make the coordinates.
  for (int pass = 0; pass < 2; ++pass) {
    Gaps(pass == 0 ? q : origin_, &gaps, &rows);
    SplitRowSpace(rows, kRankTolerance, &position_normals_, &position_basis_);
    origin_ = Close(pass == 0 ? q : origin_);
  }
  if (scene.travel_joint >= 0) {
    without_travel.resize(rows.rows() + 1, rows.cols());
    without_travel << rows, VectorX::Unit(rows.cols(), scene.travel_joint).transpose();
    MatrixX unused;
    SplitRowSpace(without_travel, kRankTolerance, &unused, &position_basis_);
  }
  SplitRowSpace(SlipRows(origin_), kRankTolerance, &velocity_normals_, &velocity_basis_);
}

void GaitSection::Gaps(const VectorX& q, VectorX* gaps, MatrixX* jacobian) {
  const int m = static_cast<int>(touching_.size());
  gaps->resize(m);
  jacobian->resize(m, q.size());
  dynamics_.SetState(0, dynamics_.MakeState(q, VectorX::Zero(q.size()), 0));
  MatrixX linear, angular;
  for (int i = 0; i < m; ++i) {
    const int k = touching_[static_cast<size_t>(i)];
    dynamics_.contacts().SlipJacobian(k, &linear, &angular);
    (*gaps)[i] = dynamics_.contacts().Kinematics(k).gap;
    jacobian->row(i) = dynamics_.contacts().Kinematics(k).normal.transpose() * linear;
  }
}

MatrixX GaitSection::SlipRows(const VectorX& q) {
  dynamics_.SetState(0, dynamics_.MakeState(q, VectorX::Zero(q.size()), 0));
  MatrixX rows;
  VectorX rate;
  dynamics_.contacts().VelocityRows(dynamics_.active(), &rows, &rate);
  return rows;
}

VectorX GaitSection::Close(VectorX q) {
  VectorX gaps;
  MatrixX rows;
  double last = kInfinity;
  for (int i = 0; i < 50; ++i) {
    Gaps(q, &gaps, &rows);
    const double worst = gaps.cwiseAbs().maxCoeff();
    if (worst == 0 || (i > 3 && worst >= last)) break;
    last = worst;
    q -= position_normals_ * SolveLeastNorm(rows * position_normals_, gaps).x;
  }
  return q;
}

VectorX GaitSection::Coordinates(const VectorX& q, const VectorX& v) const {
  VectorX y(dimension());
  y << position_basis_.transpose() * (q - origin_), velocity_basis_.transpose() * v;
  return y;
}

void GaitSection::State(const VectorX& y, VectorX* q, VectorX* v) {
  *q = Close(origin_ + position_basis_ * y.head(position_basis_.cols()));
  const VectorX along = velocity_basis_ * y.tail(velocity_basis_.cols());
  const MatrixX rows = SlipRows(*q);
  *v = along - velocity_normals_ * SolveLeastNorm(rows * velocity_normals_, rows * along).x;
}

Result<PeriodicGait> FindPeriodicGait(const SimulationScene& scene, const PeriodicGaitOptions& options,
                                      const PeriodicGaitObserver& observer, const StopFlag* stop) {
  Violations violations = CheckWalker(scene);
  if (!violations.empty()) return violations;
  StepMap map(scene, stop);
  PeriodicGait gait;
  SceneDynamics dynamics(scene);
  const Result<VectorX> start = InitialState(scene, &dynamics);
  if (!start.ok()) return start.violations();
  VectorX q = dynamics.Positions(start.value()), v = dynamics.Velocities(start.value()), image;
  std::optional<GaitSection> section;
  for (;; ++gait.iterations) {
    section.emplace(scene, q);
    if (section->dimension() == 0) {
      return Violations{
          {"contacts", "leave the walker no freedom right after a heel strike; fewer directions or feet"}};
    }
    VectorX y = section->Coordinates(q, v);
    if (!MapCoordinates(y, &*section, &map, &image)) {
      return Violations{{"joints",
                         "a step from the state at t = 0 does not end with the other foot's heel strike within "
                         "duration_s; start closer to a gait, or open the gates of the swing foot"}};
    }
    gait.residual = (image - y).cwiseAbs().maxCoeff();
    const bool go_on = !observer || observer(gait.iterations, gait.residual);
    gait.converged = gait.residual <= options.residual;
    MatrixX jacobian;
    if (!Differentiate(y, options.difference_step, &*section, &map, &jacobian)) {
      return Violations{{"joints",
                         "a step from a state near the one found does not end with the other foot's heel strike; "
                         "start closer to a gait"}};
    }
    gait.jacobian = jacobian;
    if (gait.converged || !go_on || gait.iterations >= options.max_iterations) break;
    const MatrixX system = jacobian - MatrixX::Identity(y.size(), y.size());
    // Steps out of the region where the walker still makes a step are halved.
    VectorX newton = -SolveLeastNorm(system, image - y).x;
    for (int halving = 0; halving < 20; ++halving, newton *= 0.5) {
      VectorX trial;
      if (!MapCoordinates(y + newton, &*section, &map, &trial)) continue;
      const double residual = (trial - y - newton).cwiseAbs().maxCoeff();
      if (residual < gait.residual || residual < 1e-9) break;
    }
    section->State(y + newton, &q, &v);
  }
  section->State(section->Coordinates(q, v), &gait.q, &gait.v);
  // The bases of two sections may differ by any rotation, however near they are: the derivative belongs to the one at
  // the gait.
  section.emplace(scene, gait.q);
  if (!Differentiate(section->Coordinates(gait.q, gait.v), options.difference_step, &*section, &map, &gait.jacobian)) {
    return Violations{
        {"joints", "a step from a state near the gait found does not end with the other foot's heel strike"}};
  }
  VectorX q_next, v_next;
  if (map.Map(gait.q, gait.v, &q_next, &v_next)) {
    gait.heel_strike = map.heel_strike();
    gait.report = map.report();
    gait.period = gait.heel_strike.time;
    if (scene.travel_joint >= 0) gait.step_length = q_next[scene.travel_joint] - gait.q[scene.travel_joint];
  }
  gait.eigenvalues = Eigenvalues(gait.jacobian);
  std::sort(gait.eigenvalues.begin(), gait.eigenvalues.end(), [](const auto& a, const auto& b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
  return gait;
}

}  // namespace rollgait
