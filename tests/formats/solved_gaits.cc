#include "tests/formats/solved_gaits.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <filesystem>

#include "client/json.h"

namespace rollgait::client {
namespace {

int Index(const v1::Model& model, const std::string& joint) {
  for (int i = 0; i < model.joints_size(); ++i) {
    if (model.joints(i).name() == joint) return i;
  }
  throw std::runtime_error("no joint " + joint);
}

// A of the Runge-Kutta scheme with the stages c: A_ij = ∫ l_j from 0 to c_i, by the moments Σ_j A_ij c_j^k =
// c_i^(k+1)/(k+1).
Eigen::MatrixXd SchemeMatrix(const Eigen::VectorXd& c) {
  const int s = static_cast<int>(c.size());
  Eigen::MatrixXd powers(s, s), integrals(s, s);
  for (int k = 0; k < s; ++k) {
    powers.col(k) = c.array().pow(k);
    integrals.col(k) = c.array().pow(k + 1) / (k + 1);
  }
  return integrals * powers.inverse();
}

// Of the ground at point `i`; zero where the contact is not in the phase.
Eigen::Vector3d ForceOn(const std::string& contact, const v1::TrajectoryPhase& phase, int i) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int m = 0; m < phase.contacts_size(); ++m) {
    if (phase.contacts(m) != contact) continue;
    for (int axis = 0; axis < 3; ++axis) {
      force(axis) = phase.point_forces().values(i * phase.point_forces().columns() + 3 * m + axis);
    }
  }
  return force;
}

}  // namespace

v1::Solve ReadGait(const std::string& name) {
  v1::Solve solve;
  solve.set_name("solves/" + name);
  solve.set_state(v1::SOLVE_STATE_SUCCEEDED);
  ReadJsonFile(std::string(SPECS) + "/" + name + ".json", *solve.mutable_spec());
  ReadJsonFile(std::string(GAITS) + "/" + name + ".json", *solve.mutable_result());
  return solve;
}

std::vector<StagePoint> StagePoints(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = solve.result().trajectory();
  const v1::Model& model = solve.result().model();
  const int n = model.joints_size(), s = trajectory.points_per_interval();
  std::vector<int> joints, actuated;
  for (const std::string& name : trajectory.joint_names()) joints.push_back(Index(model, name));
  for (const std::string& name : trajectory.actuated_joint_names()) actuated.push_back(Index(model, name));
  std::vector<StagePoint> points;
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    const auto row = [](const v1::Matrix& matrix, int i, const std::vector<int>& columns, int size) {
      Eigen::VectorXd values = Eigen::VectorXd::Zero(size);
      for (int j = 0; j < matrix.columns(); ++j) values(columns[j]) = matrix.values(i * matrix.columns() + j);
      return values;
    };
    for (int k = 0; k + 1 < phase.node_times_s_size(); ++k) {
      const double h = phase.node_times_s(k + 1) - phase.node_times_s(k);
      Eigen::VectorXd c(s);
      Eigen::MatrixXd accelerations(n, s);
      for (int j = 0; j < s; ++j) {
        c(j) = (phase.point_times_s(s * k + j) - phase.node_times_s(k)) / h;
        accelerations.col(j) = row(phase.point_accelerations(), s * k + j, joints, n);
      }
      const Eigen::MatrixXd a = SchemeMatrix(c);
      const Eigen::VectorXd q = row(phase.node_positions(), k, joints, n);
      const Eigen::VectorXd v = row(phase.node_velocities(), k, joints, n);
      for (int j = 0; j < s; ++j) {
        const int i = s * k + j;
        StagePoint point;
        point.time_s = phase.point_times_s(i);
        point.position = q + h * c(j) * v + h * h * accelerations * (a * a).row(j).transpose();
        point.velocity = row(phase.point_velocities(), i, joints, n);
        point.acceleration = accelerations.col(j);
        point.effort = row(phase.point_efforts(), i, actuated, n);
        for (const v1::ContactSurface& contact : model.contacts()) {
          point.force.push_back(ForceOn(contact.name(), phase, i));
        }
        points.push_back(point);
      }
    }
  }
  return points;
}

Eigen::Vector3d LowestOf(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& semi_axes) {
  const Eigen::Vector3d scaled = semi_axes.asDiagonal() * axes.transpose() * Eigen::Vector3d(0, 0, -1);
  return center + axes * semi_axes.asDiagonal() * scaled.normalized();
}

std::string WriteScratch(const std::string& name, const std::string& content) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("formats_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / name).string();
  WriteFile(path, content);
  return path;
}

}  // namespace rollgait::client
