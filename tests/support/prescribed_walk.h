// A trajectory that follows prescribed curves without obeying any dynamics: every curve is linear between its samples.
#ifndef ROLLGAIT_TESTS_SUPPORT_PRESCRIBED_WALK_H_
#define ROLLGAIT_TESTS_SUPPORT_PRESCRIBED_WALK_H_

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/trajectory.h"

namespace rollgait {

struct PrescribedWalk {
  using Curve = std::function<double(double percent)>;  // period 100

  double stride_time = 1.1;              // s
  double stride = 1.4;                   // m
  double toe_off = 60;                   // % of the right leg, 50 … 100; the left leg is half a cycle later
  std::map<std::string, Curve> angles;   // rad, of the right leg by the joint's name without side
  std::map<std::string, Curve> efforts;  // N m, likewise
  Curve vertical = [](double) { return 0; }, forward = [](double) { return 0; };  // N, on the right foot

  // `start`: % of the cycle where the trajectory begins; a multiple of 0.5.
  Trajectory Make(const Scene& scene, Cycle cycle, double start) const {
    Trajectory t;
    t.point_fractions = {1.0 / 3, 1};
    t.cycle = cycle;
    const double span = cycle == Cycle::kHalf ? 50 : 100;
    t.duration = span / 100 * stride_time;
    t.displacement = span / 100 * stride;
    double at = start;
    while (at < start + span - 1e-9) {
      double end = start + span;  // of the phase
      for (const double border : {0.0, toe_off - 50, 50.0, toe_off, 100.0, 150.0, toe_off + 50, toe_off + 100}) {
        if (border > at + 1e-9 && border < end) end = border;
      }
      t.phases.push_back(Phase(scene, start, at, end));
      at = end;
    }
    return t;
  }

 private:
  static double Wrapped(double percent) { return percent - 100 * std::floor(percent / 100 + 1e-12); }

  TrajectoryPhase Phase(const Scene& scene, double origin, double begin, double end) const {
    TrajectoryPhase phase;
    const double middle = (begin + end) / 2;
    for (const bool left : {true, false}) {
      if (Wrapped(middle + (left ? 50 : 0)) > toe_off) continue;
      phase.contacts.push_back(scene.FindContact(left ? "left_foot" : "right_foot"));
    }
    const int n = static_cast<int>(std::lround((end - begin) / 0.5));
    phase.start = (begin - origin) / 100 * stride_time;
    phase.duration = (end - begin) / 100 * stride_time;
    const int joints = scene.model.size();
    phase.node_positions = phase.node_velocities = MatrixX::Zero(joints, n + 1);
    for (int k = 0; k <= n; ++k) {
      const double percent = begin + 0.5 * k;
      phase.node_times.push_back((percent - origin) / 100 * stride_time);
      phase.node_positions.col(k) = Position(scene, percent, origin);
      phase.node_velocities.col(k) =
          (Position(scene, percent + 0.5, origin) - phase.node_positions.col(k)) / (0.005 * stride_time);
    }
    phase.point_accelerations = MatrixX::Zero(joints, 2 * n);
    phase.point_efforts = MatrixX::Zero(static_cast<int>(scene.model.actuated().size()), 2 * n);
    phase.point_forces = MatrixX::Zero(3 * static_cast<int>(phase.contacts.size()), 2 * n);
    for (int p = 0; p < 2 * n; ++p) {
      const double percent = begin + 0.5 * (p / 2 + (p % 2 == 0 ? 1.0 / 3 : 1.0));
      for (size_t a = 0; a < scene.model.actuated().size(); ++a) {
        const std::string& name = scene.model.joint(scene.model.actuated()[a]).name;
        const auto curve = efforts.find(name.substr(0, name.size() - 2));
        if (curve == efforts.end()) continue;
        phase.point_efforts(static_cast<int>(a), p) = curve->second(Wrapped(percent + (name.ends_with("_l") ? 50 : 0)));
      }
      for (size_t c = 0; c < phase.contacts.size(); ++c) {
        const double own = percent + (scene.contacts[phase.contacts[c]].name == "left_foot" ? 50 : 0);
        phase.point_forces(3 * static_cast<int>(c), p) = forward(Wrapped(own));
        phase.point_forces(3 * static_cast<int>(c) + 2, p) = vertical(Wrapped(own));
      }
    }
    return phase;
  }

  VectorX Position(const Scene& scene, double percent, double origin) const {
    VectorX q = VectorX::Zero(scene.model.size());
    for (const auto& [name, curve] : angles) {
      q[scene.model.Find(name + "_r")] = curve(Wrapped(percent));
      q[scene.model.Find(name + "_l")] = curve(Wrapped(percent + 50));
    }
    q[scene.model.Find("base_x")] = (percent - origin) / 100 * stride;
    q[scene.model.Find("base_z")] = scene.leg_length;
    return q;
  }
};

// Through samples at equal steps of the cycle.
inline PrescribedWalk::Curve Through(const std::vector<double>& samples, double factor) {
  return [samples, factor](double percent) {
    const double place = percent / 100 * static_cast<double>(samples.size());
    const auto before = static_cast<size_t>(place + 1e-9) % samples.size();
    const double part = place + 1e-9 - std::floor(place + 1e-9);
    return factor * ((1 - part) * samples[before] + part * samples[(before + 1) % samples.size()]);
  };
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_PRESCRIBED_WALK_H_
