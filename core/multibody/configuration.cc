#include "core/multibody/configuration.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

using Eigen::Quaterniond;

Quaterniond QuaternionAt(const VectorX& q, int index) {
  return Quaterniond(q[index], q[index + 1], q[index + 2], q[index + 3]);
}

void Store(const Quaterniond& rotation, int index, VectorX* q) {
  q->segment<4>(index) << rotation.w(), rotation.x(), rotation.y(), rotation.z();
}

}  // namespace

void PositionRate(const Model& model, const VectorX& q, const VectorX& v, VectorX* rate) {
  ROLLGAIT_CHECK(q.size() == model.nq() && v.size() == model.nv());
  rate->resize(model.nq());
  for (int i = 0; i < model.size(); ++i) {
    const int iq = model.q_index(i), iv = model.v_index(i);
    if (!model.joint(i).kind().is_free()) {
      (*rate)[iq] = v[iv];
      continue;
    }
    const Quaterniond rotation = QuaternionAt(q, iq);
    const Quaterniond turn = rotation * Quaterniond(0, 0.5 * v[iv], 0.5 * v[iv + 1], 0.5 * v[iv + 2]);
    Store(turn, iq, rate);
    rate->segment<3>(iq + 4) = rotation.normalized() * Vector3(v.segment<3>(iv + 3));
  }
}

VectorX Retract(const Model& model, const VectorX& q, const VectorX& delta) {
  ROLLGAIT_CHECK(q.size() == model.nq() && delta.size() == model.nv());
  VectorX result = q;
  for (int i = 0; i < model.size(); ++i) {
    const int iq = model.q_index(i), iv = model.v_index(i);
    if (!model.joint(i).kind().is_free()) {
      result[iq] += delta[iv];
      continue;
    }
    const Quaterniond rotation = QuaternionAt(q, iq).normalized();
    const Vector3 turn = delta.segment<3>(iv);
    const double angle = turn.norm();
    const double half_sinc = angle > 0 ? std::sin(0.5 * angle) / angle : 0.5;
    const Vector3 u = half_sinc * turn;
    Store(rotation * Quaterniond(std::cos(0.5 * angle), u.x(), u.y(), u.z()), iq, &result);
    result.segment<3>(iq + 4) += rotation * Vector3(delta.segment<3>(iv + 3));
  }
  return result;
}

double NormalizeQuaternions(const Model& model, VectorX* q) {
  double worst = 0;
  for (int i = 0; i < model.size(); ++i) {
    if (!model.joint(i).kind().is_free()) continue;
    const double norm = q->segment<4>(model.q_index(i)).norm();
    worst = std::max(worst, std::abs(norm - 1));
    q->segment<4>(model.q_index(i)) /= norm;
  }
  return worst;
}

VectorX NeutralConfiguration(const Model& model) {
  VectorX q = VectorX::Zero(model.nq());
  for (int i = 0; i < model.size(); ++i) {
    if (model.joint(i).kind().is_free()) q[model.q_index(i)] = 1;
  }
  return q;
}

}  // namespace rollgait
