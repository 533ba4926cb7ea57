#include "tests/formats/mujoco_model.h"

#include <stdexcept>

#include "tests/formats/solved_gaits.h"

namespace rollgait::client {
namespace {

mjModel* Load(const std::string& path) {
  char message[1000] = "";
  mjModel* const model = mj_loadXML(path.c_str(), nullptr, message, sizeof(message));
  if (model == nullptr) throw std::runtime_error(path + ": " + message);
  return model;
}

}  // namespace

MujocoModel::MujocoModel(const std::string& path)
    : model_(Load(path), mj_deleteModel), data_(mj_makeData(model_.get()), mj_deleteData) {
  model_->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT;
}

int MujocoModel::Find(mjtObj kind, const std::string& name) const {
  const int id = mj_name2id(model_.get(), kind, name.c_str());
  if (id < 0) throw std::runtime_error("MuJoCo has no " + std::string(mju_type2Str(kind)) + " " + name);
  return id;
}

void MujocoModel::Set(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a) {
  Eigen::Map<Eigen::VectorXd>(data_->qpos, model_->nq) = q;
  Eigen::Map<Eigen::VectorXd>(data_->qvel, model_->nv) = v;
  Eigen::Map<Eigen::VectorXd>(data_->qacc, model_->nv) = a;
  mj_fwdPosition(model_.get(), data_.get());
}

Eigen::VectorXd MujocoModel::InverseDynamics() {
  mj_inverse(model_.get(), data_.get());
  return Eigen::Map<Eigen::VectorXd>(data_->qfrc_inverse, model_->nv);
}

Eigen::VectorXd MujocoModel::Generalized(const Eigen::Vector3d& force, const Eigen::Vector3d& point, int body) {
  Eigen::VectorXd generalized = Eigen::VectorXd::Zero(model_->nv);
  const Eigen::Vector3d couple = Eigen::Vector3d::Zero();
  mj_applyFT(model_.get(), data_.get(), force.data(), couple.data(), point.data(), body, generalized.data());
  return generalized;
}

Eigen::Vector3d MujocoModel::LowestPoint(int geom) const {
  return LowestOf(Eigen::Map<const Eigen::Vector3d>(data_->geom_xpos + 3 * geom), Rows(data_->geom_xmat + 9 * geom),
                  Eigen::Map<const Eigen::Vector3d>(model_->geom_size + 3 * geom));
}

}  // namespace rollgait::client
