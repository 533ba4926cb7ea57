// Where double precision ends in contact dynamics: errors of forces and accelerations and the condition number that
// explains them, as CSV: plot,series,x,y (docs/plot_limits.py). References: the same equations in long double, or
// closed forms.
//   dynamics_limits > dynamics.csv

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/contact/contact_dynamics.h"
#include "core/multibody/configuration.h"
#include "tests/support/seeded_random.h"
#include "tests/support/standing_plate.h"

namespace rollgait {
namespace {

using Long = long double;
using LongVector = Eigen::Matrix<Long, 3, 1>;
using LongMatrix = Eigen::Matrix<Long, 3, 3>;

constexpr int kCases = 200;

void Print(const char* plot, const std::string& series, double x, Long y) {
  std::printf("%s,%s,%.6g,%.6Lg\n", plot, series.c_str(), x, std::max(y, 1e-18L));
}

LongMatrix Cross(const LongVector& u) {
  LongMatrix m;
  m << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
  return m;
}

// Worst of many homogeneous ellipsoids that roll on z = 0.
struct Errors {
  Long force = 0, angular = 0;
  double condition = 1;
};

// Force of a rolling ellipsoid from  K f = −g − ω × ṙ + (I⁻¹ (ω × I ω)) × r,  K = 1/m − [r] I⁻¹ [r].
struct Extreme {
  double mass = 1, ratio = 2, speed = 5, gravity = 9.81;
  double distance = 0;  // m, from the origin of the world
};

void AddCase(const Extreme& extreme, SeededRandom* random, Errors* errors) {
  const auto [mass, ratio, speed, gravity, distance] = extreme;
  const Vector3 axes(0.1, 0.1 / ratio, 0.1 * (1 + random->Uniform(0, 1)) / (2 * ratio));
  const Vector3 squares = axes.cwiseAbs2();
  Joint joint;
  joint.name = "body", joint.type = JointType::kFree, joint.mass = mass;
  joint.inertia = (mass / 5 * (Vector3::Constant(squares.sum()) - squares)).asDiagonal();
  const Model model = Model::Create({joint}).value();
  TreeContact contact;
  contact.surface.surface = Ellipsoid(axes);
  ContactDynamics dynamics(BodyDynamics(model), {contact});
  VectorX q = NeutralConfiguration(model), v = VectorX::Zero(6);
  q.head<4>() = random->VectorOf(4, -1, 1).normalized();
  q[4] = distance;
  const Vector3 omega_body = speed * random->Unit(), g(0.1 * gravity, 0, -gravity);
  v.head<3>() = omega_body;
  dynamics.SetState(q, v, {FrameMotion{}});
  const Vector3 force = dynamics.Accelerate({0}, VectorX::Zero(6), g, {}).forces;
  const Vector3 angular = dynamics.solution().acceleration.head<3>();

  const LongMatrix R = dynamics.state()[0].R_WL.cast<Long>();
  const LongVector a = axes.cast<Long>(), nu = -R.row(2).transpose(), w = R * omega_body.cast<Long>();
  const Long h = a.cwiseProduct(nu).norm();
  const LongVector c(a.y() * a.z(), a.x() * a.z(), a.x() * a.y());
  const LongMatrix S = Cross(nu).transpose() * c.cwiseAbs2().asDiagonal() * Cross(nu) / (h * h * h);
  const LongVector r = R * (a.cwiseAbs2().cwiseProduct(nu) / h);
  const LongVector r_dot = w.cross(r) + R * (S * nu.cross(LongVector(omega_body.cast<Long>())));
  const LongMatrix inertia = R * joint.inertia.cast<Long>() * R.transpose();
  const LongVector moments = joint.inertia.diagonal().cast<Long>();
  const LongMatrix inverse = R * moments.cwiseInverse().asDiagonal() * R.transpose();
  const LongMatrix K = LongMatrix::Identity() / static_cast<Long>(mass) - Cross(r) * inverse * Cross(r);
  const LongVector gyration = inverse * w.cross(LongVector(inertia * w));
  const LongVector exact = K.inverse() * (-g.cast<Long>() - w.cross(r_dot) + LongVector(gyration.cross(r)));
  const LongVector alpha = R.transpose() * (inverse * r.cross(exact) - gyration);
  errors->force = std::max(errors->force, (force.cast<Long>() - exact).norm() / exact.norm());
  errors->angular = std::max(errors->angular, (angular.cast<Long>() - alpha).norm() / alpha.norm());
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(Matrix3(K.cast<double>()));
  const double turning = joint.inertia.diagonal().maxCoeff() / joint.inertia.diagonal().minCoeff();
  errors->condition = std::max({errors->condition, eigen.eigenvalues()[2] / eigen.eigenvalues()[0], turning});
}

void PrintErrors(const char* plot, double x, const Errors& errors) {
  Print(plot, "force", x, errors.force);
  Print(plot, "angular acceleration", x, errors.angular);
  Print(plot, "condition number times epsilon", x, errors.condition * 2.2e-16L);
}

void Bodies(SeededRandom* random) {
  const auto worst = [&](const Extreme& extreme) {
    Errors errors;
    for (int i = 0; i < kCases; ++i) AddCase(extreme, random, &errors);
    return errors;
  };
  const auto power = [](double e) { return std::pow(10, e); };
  for (int e = -3; e <= 6; ++e) PrintErrors("body_mass", power(e), worst({.mass = power(e)}));
  for (int e = -1; e <= 6; ++e) PrintErrors("body_speed", power(e), worst({.speed = power(e)}));
  for (int e = -1; e <= 6; ++e) PrintErrors("body_weightless", power(e), worst({.speed = power(e), .gravity = 0}));
  for (double e = 0; e <= 3.01; e += 0.5) PrintErrors("body_ratio", power(e), worst({.ratio = power(e)}));
  for (int e = 0; e <= 6; ++e) PrintErrors("body_place", power(e), worst({.distance = power(e)}));
}

// Two links that slide along one line, the second on the first:  a_1 = (τ_1 − τ_2)/m_1,  a_2 = τ_2/m_2 − a_1.
void MassRatio() {
  for (int e = -9; e <= 9; ++e) {
    const double m_1 = 1, m_2 = std::pow(10, e);
    std::vector<Joint> joints(2);
    for (int i = 0; i < 2; ++i) {
      Joint& joint = joints[static_cast<size_t>(i)];
      joint.name = "x" + std::to_string(i), joint.type = JointType::kPrismatic, joint.axis = Vector3::UnitX();
      joint.parent = i - 1, joint.mass = i == 0 ? m_1 : m_2, joint.inertia = Matrix3::Identity();
    }
    ContactDynamics dynamics(BodyDynamics(Model::Create(joints).value()), {});
    dynamics.SetState(VectorX::Zero(2), VectorX::Zero(2), {FrameMotion{}});
    const Eigen::Vector2d tau(0.7, 0.4);
    const VectorX found = dynamics.Accelerate({}, tau, Vector3::Zero(), {}).acceleration;
    const Long a_1 = (static_cast<Long>(tau[0]) - tau[1]) / m_1, a_2 = static_cast<Long>(tau[1]) / m_2 - a_1;
    const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(dynamics.MassMatrix());
    Print("mass_ratio", "acceleration of the first link", m_2, std::abs(found[0] - a_1) / std::abs(a_1));
    Print("mass_ratio", "acceleration of the second link", m_2, std::abs(found[1] - a_2) / std::abs(a_2));
    const double condition = eigen.eigenvalues()[1] / eigen.eigenvalues()[0];
    Print("mass_ratio", "condition number times epsilon", m_2, condition * 2.2e-16L);
  }
}

// Three feet, the third off the line of the others by δ. In balance each carries a third of the weight. Off balance,
// the centre of mass 0.3 m from the line, the third holds −W (0.3 − δ/3)/δ; nothing accelerates. Contacts that depend
// on each other within rounding are reported: `ForcesUnique`.
void NearlyDependent(const char* plot, double off) {
  const double weight = 3 * 9.81;
  for (int e = 0; e >= -15; --e) {
    const double delta = std::pow(10, e), third = off + 2 * delta / 3;
    testing::StandingPlate stand({{-1, off - delta / 3, 0}, {1, off - delta / 3, 0}, {0, third, 0}},
                                 Grip::kFrictionless);
    const ConstrainedSolution& solution = stand.dynamics.Accelerate(stand.active, VectorX::Zero(6), {0, 0, -9.81}, {});
    const Vector3 feet = solution.forces;
    const double last = -weight * (off - delta / 3) / delta, others = (weight - last) / 2;
    const double error = (feet - Vector3(others, others, last)).cwiseAbs().maxCoeff() / std::abs(last);
    Print(plot, solution.ForcesUnique() ? "force" : "force (reported as not unique)", delta, error);
    Print(plot, solution.redundant ? "acceleration / g (rank 2)" : "acceleration / g", delta,
          solution.acceleration.norm() / 9.81);
    if (solution.redundant) continue;
    Print(plot, "epsilon / independence", delta, 2.2e-16 / solution.independence);
    Print(plot, "epsilon / independence squared", delta, 2.2e-16 / (solution.independence * solution.independence));
  }
}

// Feet with grip on a circle: 3 n rows of rank 6.
void Redundant() {
  for (int n = 2; n <= 16; ++n) {
    std::vector<Vector3> places;
    for (int k = 0; k < n; ++k) places.push_back({std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n), 0});
    testing::StandingPlate stand(places, Grip::kRolling);
    const ConstrainedSolution& solution = stand.dynamics.Accelerate(stand.active, VectorX::Zero(6), {1, 0, -9.81}, {});
    Vector3 sum = Vector3::Zero();
    for (int k : stand.active) sum += stand.dynamics.Force(k);
    Print("feet", "acceleration / g", n, solution.acceleration.norm() / 9.81);
    Print("feet", "sum of forces", n, (sum - Vector3(-3, 0, 3 * 9.81)).norm() / (3 * 9.81));
  }
}

}  // namespace
}  // namespace rollgait

int main() {
  std::puts("plot,series,x,y");
  rollgait::SeededRandom random(4);
  rollgait::Bodies(&random);
  rollgait::MassRatio();
  rollgait::NearlyDependent("feet_in_line", 0);
  rollgait::NearlyDependent("feet_off_balance", 0.3);
  rollgait::Redundant();
  return 0;
}
