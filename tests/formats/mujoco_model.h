// A model file in MuJoCo, without the contacts and limits of the simulator: forces are what a test says.
#ifndef ROLLGAIT_TESTS_FORMATS_MUJOCO_MODEL_H_
#define ROLLGAIT_TESTS_FORMATS_MUJOCO_MODEL_H_

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>
#include <string>

namespace rollgait::client {

class MujocoModel {
 public:
  // Reads an MJCF or URDF file. Throws std::runtime_error with MuJoCo's message.
  explicit MujocoModel(const std::string& path);

  const mjModel& model() const { return *model_; }
  mjModel& model() { return *model_; }
  const mjData& data() const { return *data_; }

  // Throws std::runtime_error if there is none of that name.
  int Find(mjtObj kind, const std::string& name) const;
  // Index in v of a joint, and in q.
  int Dof(const std::string& joint) const { return model_->jnt_dofadr[Find(mjOBJ_JOINT, joint)]; }

  int Q(const std::string& joint) const { return model_->jnt_qposadr[Find(mjOBJ_JOINT, joint)]; }

  // Sets the state; kinematics are those of it.
  void Set(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a);
  // M a + bias, by mj_inverse.
  Eigen::VectorXd InverseDynamics();
  // Generalised forces of a force in N at a point of a body in m, world axes, by mj_applyFT.
  Eigen::VectorXd Generalized(const Eigen::Vector3d& force, const Eigen::Vector3d& point, int body);

  Eigen::Vector3d BodyPosition(int body) const { return Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body); }
  Eigen::Matrix3d BodyAxes(int body) const { return Rows(data_->xmat + 9 * body); }
  // Lowest point of an ellipsoid geom.
  Eigen::Vector3d LowestPoint(int geom) const;

 private:
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  static Eigen::Matrix3d Rows(const double* values) { return Eigen::Map<const RowMajor>(values); }

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_FORMATS_MUJOCO_MODEL_H_
