#include "core/simulation/initial_state.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/math/dense_solve.h"
#include "core/multibody/configuration.h"

namespace rollgait {
namespace {

constexpr int kIterations = 50;
constexpr double kRelative = 1e-7;
constexpr double kAbsolute = 1e-9;

// Columns of the adjusted joints in v; of a free joint the translation.
std::vector<int> AdjustedColumns(const SimulationScene& scene) {
  std::vector<int> columns;
  for (int joint : scene.adjusted_joints) {
    const int iv = scene.model.v_index(joint);
    if (scene.model.joint(joint).kind().is_free()) {
      for (int c = 3; c < 6; ++c) columns.push_back(iv + c);
    } else {
      columns.push_back(iv);
    }
  }
  return columns;
}

MatrixX Select(const MatrixX& matrix, const std::vector<int>& columns) {
  MatrixX part(matrix.rows(), static_cast<int>(columns.size()));
  for (size_t i = 0; i < columns.size(); ++i) part.col(static_cast<int>(i)) = matrix.col(columns[i]);
  return part;
}

std::string Value(double value, const char* unit) {
  std::ostringstream text;
  text.precision(6);
  text << value << " " << unit;
  return text.str();
}

}  // namespace

Result<VectorX> InitialState(const SimulationScene& scene, SceneDynamics* dynamics) {
  const std::vector<int> columns = AdjustedColumns(scene);
  const std::vector<int>& active = dynamics->active();
  const int nv = scene.model.nv(), m = static_cast<int>(active.size());
  VectorX q = scene.q, v = scene.v;
  NormalizeQuaternions(scene.model, &q);
  ContactDynamics& contacts = dynamics->contacts();
  MatrixX linear, angular, jacobian(m, nv);
  VectorX gaps(m);
  double last = kInfinity;
  for (int iteration = 0; !columns.empty() && m > 0 && iteration < kIterations; ++iteration) {
    dynamics->SetState(0, dynamics->MakeState(q, v, 0));
    for (int i = 0; i < m; ++i) {
      const PairKinematics& pair = contacts.Kinematics(active[static_cast<size_t>(i)]);
      contacts.SlipJacobian(active[static_cast<size_t>(i)], &linear, &angular);
      jacobian.row(i) = pair.normal.transpose() * linear;
      gaps[i] = pair.gap;
    }
    const double worst = gaps.cwiseAbs().maxCoeff();
    if (worst == 0 || (iteration > 3 && worst >= last)) break;
    last = worst;
    const VectorX step = SolveLeastNorm(Select(jacobian, columns), -gaps).x;
    VectorX delta = VectorX::Zero(nv);
    for (size_t c = 0; c < columns.size(); ++c) delta[columns[c]] = step[static_cast<int>(c)];
    q = Retract(scene.model, q, delta);
  }
  if (!columns.empty() && m > 0) {
    for (int c : columns) v[c] = 0;
    dynamics->SetState(0, dynamics->MakeState(q, v, 0));
    VectorX rate;
    contacts.VelocityRows(active, &jacobian, &rate);
    const VectorX speed = SolveLeastNorm(Select(jacobian, columns), -rate).x;
    for (size_t c = 0; c < columns.size(); ++c) v[columns[c]] = speed[static_cast<int>(c)];
  }

  const VectorX x = dynamics->MakeState(q, v, 0);
  dynamics->SetState(0, x);
  Violations violations;
  for (int k : active) {
    const PairKinematics& pair = contacts.Kinematics(k);
    const std::string field = "contacts[" + std::to_string(k) + "].active";
    const double size = pair.p_1.norm() + contacts.contact(k).surface.surface.Support(Vector3::UnitZ());
    if (!(std::abs(pair.gap) <= kAbsolute + kRelative * size)) {
      violations.push_back({field, "but the gap at t = 0 is " + Value(pair.gap, "m") +
                                       "; move the body, or name joints in adjusted_joints that may close it"});
    }
    VectorX rate;
    MatrixX rows;
    contacts.VelocityRows({k}, &rows, &rate);
    const double limit = kAbsolute + kRelative * (rows.cwiseAbs() * v.cwiseAbs()).maxCoeff();
    const Vector3 slip = dynamics->TangentialSlip(k);
    if (dynamics->MaySlide(k) && slip.norm() > limit) {
      dynamics->Slide(k, slip.normalized());
      contacts.VelocityRows({k}, &rows, &rate);
    }
    if (!(rate.cwiseAbs().maxCoeff() <= limit)) {
      violations.push_back({field, "but the contact slips at " + Value(rate.cwiseAbs().maxCoeff(), "m/s") +
                                       " at t = 0; set velocities that roll, or name joints in adjusted_joints"});
    }
  }
  if (!violations.empty()) return violations;
  return x;
}

}  // namespace rollgait
