// Value, Jacobian and Hessian of the rolling of one body on a fixed plane with respect to z = (θ, ω_b, u_b): R = R₀
// exp([θ]), angular velocity and torque about the centre of mass in body axes.
//
// All of θ enters through ν(θ) = exp(−[θ]) ν and the gravity in body axes; x(ν), S(ν) are expanded with the library's
// S, T and Q, the rest is algebra on numbers that carry two derivatives. The bias is compared once more from
// PairHessians. The reference folder's README gives no double tolerance for this family. Used here, relative to the
// norm of the value, of the Jacobian and of the Hessian: 100 ε k, or what the README gives for ω̇, 1e-15 k², if that is
// more.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/contact/pair_hessians.h"
#include "core/geometry/surface.h"
#include "core/multibody/spatial.h"
#include "tests/reference_check/families.h"
#include "tests/reference_check/jet.h"

namespace rollgait::reference {
namespace rolling_derivatives {

constexpr int kVariables = 9;
using Number = Jet<kVariables>;
using Number3 = Jet3<kVariables>;

struct Input {
  Surface surface = Sphere(1);
  RealMatrix3 R;
  Vector3 nu, omega, gravity, com;  // body axes
  double mass;
  Matrix3 inertia;
};

struct Outputs {
  Number3 omega_dot_body, contact_force_world, bias_world, r_world;
  Number minus_support;
};

// exp(sign [θ]) u to second order.
Number3 Turned(const Number3& theta, const Number3& u, double sign) {
  const Number3 once = Cross(theta, u);
  return u + Number(sign) * once + Number(0.5) * Cross(theta, once);
}

Outputs Evaluate(const Input& input) {
  Number3 theta, omega, torque;
  for (int i = 0; i < 3; ++i) {
    theta[i] = Number::Variable(0, i);
    omega[i] = Number::Variable(input.omega[i], 3 + i);
    torque[i] = Number::Variable(0, 6 + i);
  }
  const Number3 nu = Turned(theta, input.nu, -1), gravity = Turned(theta, input.gravity, -1);
  const Number3 delta = nu - Number3(input.nu);

  SupportJet jet;
  input.surface.Evaluate(input.nu, 4, &jet);
  Number3 x(jet.x), moving;  // x(ν) and S(ν)(ν × ω)
  const Number3 across = Cross(nu, omega);
  Number h(jet.h);
  for (int i = 0; i < 3; ++i) {
    h = h + Number(jet.x[i]) * delta[i];
    for (int j = 0; j < 3; ++j) {
      Number S_ij(jet.S(i, j)), x_ij(jet.S(i, j));
      for (int k = 0; k < 3; ++k) {
        S_ij = S_ij + Number(jet.T[k](i, j)) * delta[k];
        x_ij = x_ij + Number(0.5 * jet.T[k](i, j)) * delta[k];
        for (int l = 0; l < 3; ++l) {
          S_ij = S_ij + Number(0.5 * jet.Q[SupportJet::PairIndex(k, l)](i, j)) * delta[k] * delta[l];
        }
      }
      x[i] = x[i] + x_ij * delta[j];
      moving[i] = moving[i] + S_ij * across[j];
      h = h + Number(0.5 * jet.S(i, j)) * delta[i] * delta[j];
    }
  }
  const Number3 rho = x - Number3(input.com);  // centre of mass -> contact point
  const Number3 bias = Cross(omega, Cross(omega, rho) + moving);

  // (I + m (ρ² − ρ ρᵀ)) ω̇ = u − ω × I ω − m ρ × (b + g)
  const Number m(input.mass);
  std::array<Number3, 3> about_point;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) about_point[i][j] = Number(input.inertia(i, j)) - m * rho[i] * rho[j];
    // ρ² − ρ_i², without the subtraction
    about_point[i][i] =
        Number(input.inertia(i, i)) + m * (rho[(i + 1) % 3] * rho[(i + 1) % 3] + rho[(i + 2) % 3] * rho[(i + 2) % 3]);
  }
  const Number3 moment = torque - Cross(omega, input.inertia * omega) - m * Cross(rho, bias + gravity);
  const Number3 omega_dot = Solve(about_point, moment);
  const Number3 force = Number(-input.mass) * (Cross(omega_dot, rho) + bias + gravity);

  const Matrix3 R = input.R.cast<double>();
  return {omega_dot, R * Turned(theta, force, 1), R * Turned(theta, bias, 1), R * Turned(theta, x, 1), Number(-1) * h};
}

// The bias once more, from the Hessians of pairs on a plane at rest. Their variables are a turn and an angular velocity
// in world axes:  θ_W = R θ,  ω_W = R exp([θ]) (ω_b + δ) = R (ω + θ × ω + δ + ½ θ × (θ × ω) + θ × δ + …).
Number3 BiasOfPairs(const Input& input) {
  const Matrix3 R = input.R.cast<double>();
  FrameMotion body;
  body.R_WB = R;
  body.w_WB = R * input.omega;
  const PlacedSurface placed{input.surface, -input.com, Matrix3::Identity()};
  const PairHessians at = PairHessians::OnPlane(placed, body, {Vector3::Zero(), -(R * input.nu)}, FrameMotion{});
  Eigen::Matrix<double, 24, kVariables> map = Eigen::Matrix<double, 24, kVariables>::Zero();
  map.block<3, 3>(3, 0) = R;
  map.block<3, 3>(15, 0) = -R * Skew(input.omega);
  map.block<3, 3>(15, 3) = R;
  Number3 bias(at.kinematics().drift);
  for (int i = 0; i < 3; ++i) {
    const RowVector24 gradient = at.DriftDerivative().row(i);
    const Vector3 g = R.transpose() * gradient.segment<3>(15).transpose();
    bias[i].d = (gradient * map).transpose();
    bias[i].dd = map.transpose() * at.Drift(Vector3::Unit(i)) * map;
    const Matrix3 outer = g * input.omega.transpose();
    bias[i].dd.topLeftCorner<3, 3>() += 0.5 * (outer + outer.transpose()) - g.dot(input.omega) * Matrix3::Identity();
    bias[i].dd.block<3, 3>(0, 3) -= Skew(g);
    bias[i].dd.block<3, 3>(3, 0) += Skew(g);
  }
  return bias;
}

Input ReadInput(Fields* item, double* k) {
  const auto vector = [&](const char* name) { return Vector3(item->Vector3(name).cast<double>()); };
  Input input;
  const Vector3 axes = vector("semi_axes");
  if (!(axes.minCoeff() > 0)) throw ReadError(item->where() + ".semi_axes must be > 0");
  *k = axes.maxCoeff() / axes.minCoeff();
  input.surface = Ellipsoid(axes);
  input.R = item->Rotation("quat_wxyz");
  input.nu = -(input.R.transpose() * item->Vector3("plane_normal").normalized()).cast<double>();
  input.omega = vector("omega_body");
  input.gravity = (input.R.transpose() * item->Vector3("gravity_world")).cast<double>();
  input.com = vector("com_in_body");
  input.mass = item->Double("mass");
  const RealVectorX i = item->Vector("inertia_at_com_body_xx_yy_zz_xy_yz_xz");
  if (i.size() != 6) throw ReadError(item->where() + ": the inertia does not have 6 entries");
  const Eigen::Matrix<double, 6, 1> e = i.cast<double>();
  input.inertia << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
  return input;
}

// Value, Jacobian and lower triangle of the Hessian of `count` components; an output that depends on fewer variables
// has shorter lists.
void Compare(const std::string& name, const Number* numbers, int count, Fields expect, double relative,
             CaseReport* report) {
  const auto compare = [&](const std::string& what, const RealVectorX& computed, const RealVectorX& expected,
                           double tolerance) {
    report->Norm(name + "." + what, computed, expected, tolerance * expected.norm());
  };
  const auto list = [&](const Json& value, size_t size, const std::string& where) -> const Json& {
    if (!value.is_array() || value.size() != size) {
      throw ReadError(expect.where() + "." + where + " does not have " + std::to_string(size) + " entries");
    }
    return value;
  };
  const Json& values = list(expect.Get("value"), count, "value");
  const Json& jacobian = list(expect.Get("jacobian"), count, "jacobian");
  const Json& hessian = list(expect.Get("hessian"), count, "hessian");
  const size_t n = jacobian[0].size();
  if (n > kVariables) throw ReadError(expect.where() + ".jacobian has more than 9 columns");
  std::vector<Real> computed[3], expected[3];
  for (int k = 0; k < count; ++k) {
    computed[0].push_back(numbers[k].v);
    expected[0].push_back(ToReal(values[k], expect.where() + ".value"));
    list(jacobian[k], n, "jacobian");
    list(hessian[k], n, "hessian");
    for (size_t i = 0; i < n; ++i) {
      computed[1].push_back(numbers[k].d[i]);
      expected[1].push_back(ToReal(jacobian[k][i], expect.where() + ".jacobian"));
      list(hessian[k][i], i + 1, "hessian");
      for (size_t j = 0; j <= i; ++j) {
        computed[2].push_back(numbers[k].dd(i, j));
        expected[2].push_back(ToReal(hessian[k][i][j], expect.where() + ".hessian"));
      }
    }
  }
  const char* names[] = {"value", "jacobian", "hessian"};
  for (int what = 0; what < 3; ++what) {
    const auto map = [](const std::vector<Real>& list_of) {
      return RealVectorX(Eigen::Map<const RealVectorX>(list_of.data(), static_cast<int>(list_of.size())));
    };
    compare(names[what], map(computed[what]), map(expected[what]), relative);
  }
  expect.Finish();
}

void CheckCase(Fields item, Report* all) {
  CaseReport report(all, "rolling_derivatives", item.Text("family") + " " + item.Get("id").dump());
  double k = 1;
  const Input input = ReadInput(&item, &k);
  const Outputs outputs = Evaluate(input);
  const Number3 of_pairs = BiasOfPairs(input);
  const double relative = std::max(100 * kEpsilon * k, 1e-15 * k * k);
  Fields expect = item.Object("expect");
  Compare("omega_dot", outputs.omega_dot_body.e.data(), 3, expect.Object("omega_dot_body"), relative, &report);
  Compare("contact_force", outputs.contact_force_world.e.data(), 3, expect.Object("contact_force_world"), relative,
          &report);
  Compare("bias", outputs.bias_world.e.data(), 3, expect.Object("bias_world"), relative, &report);
  Compare("bias_of_pairs", of_pairs.e.data(), 3, expect.Object("bias_world"), relative, &report);
  Compare("r", outputs.r_world.e.data(), 3, expect.Object("r_center_to_contact_world"), relative, &report);
  Compare("minus_support", &outputs.minus_support, 1, expect.Object("minus_support"), relative, &report);
  expect.Finish();
  item.Finish();
}

}  // namespace rolling_derivatives

bool IsRollingDerivatives(const Document& document) { return FirstCaseHas(document, "com_in_body", "omega_dot_body"); }

void CheckRollingDerivatives(const Document& document, Report* report) {
  CheckCases(document, rolling_derivatives::CheckCase, report);
}

}  // namespace rollgait::reference
