// Where double precision ends: errors of contact kinematics against the same formulas in long double (64 bits of
// mantissa), worst of 400 random cases each, as CSV: plot,series,x,y. docs/plot_limits.py makes the pictures of
// docs/explanation/numerical_limits.md from it.
//   numerical_limits > limits.csv

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "core/contact/surface_pair.h"

namespace rollgait {
namespace {

using Long = long double;
using LongVector = Eigen::Matrix<Long, 3, 1>;
using LongMatrix = Eigen::Matrix<Long, 3, 3>;

constexpr int kCases = 400;

class Random {
 public:
  double Uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vector3 Unit() {
    Vector3 u;
    do u = Vector3(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
    while (u.norm() > 1 || u.norm() < 0.1);
    return u.normalized();
  }
  Matrix3 Rotation() { return Eigen::AngleAxisd(Uniform(0, 3.1), Unit()).toRotationMatrix(); }

 private:
  std::mt19937 engine_{1};
};

struct Exact {
  Long h;
  LongVector x, x_rel;
  LongMatrix S;
};

// Contact-math 2.1 in long double for the double inputs; ν need not be unit to the last digit.
Exact Ellipsoidal(const Vector3& axes, const Vector3& nu_double, const Vector3& omega) {
  const LongVector a = axes.cast<Long>(), nu = nu_double.cast<Long>(), w = omega.cast<Long>();
  Exact exact;
  exact.h = a.cwiseProduct(nu).norm();
  exact.x = a.cwiseAbs2().cwiseProduct(nu) / exact.h;
  const LongVector c(a.y() * a.z(), a.x() * a.z(), a.x() * a.y());
  LongMatrix skew;
  skew << 0, -nu.z(), nu.y(), nu.z(), 0, -nu.x(), -nu.y(), nu.x(), 0;
  exact.S = skew.transpose() * c.cwiseAbs2().asDiagonal() * skew / (exact.h * exact.h * exact.h);
  exact.x_rel = exact.S * nu.cross(w);
  return exact;
}

void Print(const char* plot, const std::string& series, double x, Long y) {
  std::printf("%s,%s,%.6g,%.6Lg\n", plot, series.c_str(), x, std::max(y, 1e-18L));
}

template <typename A, typename B>
Long Relative(const A& computed, const B& exact) {
  return (computed.template cast<Long>() - exact).norm() / exact.norm();
}

// Needles and pancakes of growing axis ratio; the textbook form of S for comparison.
void AxisRatio(Random* random) {
  for (double exponent = 0; exponent <= 6.01; exponent += 0.5) {
    const double k = std::pow(10, exponent);
    Long x = 0, S = 0, naive = 0, rolling = 0, distance = 0, normal = 0;
    for (int i = 0; i < kCases; ++i) {
      const Vector3 needle(1, 1 / k, random->Uniform(1, 2) / k), pancake(1, random->Uniform(0.5, 1), 1 / k);
      const Vector3 axes = i % 2 == 0 ? needle : pancake;
      const Ellipsoid body(axes);
      const Vector3 nu = random->Unit(), omega = random->Unit();
      const Exact exact = Ellipsoidal(axes, nu, omega);
      x = std::max(x, Relative(body.SupportPoint(nu), exact.x));
      S = std::max(S, Relative(body.SupportHessian(nu), exact.S));
      rolling = std::max(rolling, Relative(body.RollingVelocity(nu, omega), exact.x_rel));
      const Vector3 point = body.SupportPoint(nu);
      const Matrix3 B = axes.cwiseAbs2().asDiagonal();
      const Matrix3 textbook = (B - point * point.transpose()) / body.Support(nu);
      naive = std::max(naive, Relative(Vector3(textbook * nu.cross(omega)), exact.x_rel));
      if (exponent > 3.01) continue;
      // Two bodies built to touch at a known place: distance 0, normal R ν.
      const Matrix3 R = random->Rotation(), R_2 = random->Rotation();
      const Vector3 n = R * nu;
      const Surface one = body, two = Ellipsoid(Vector3(1, 1 / k, 1));
      const Vector3 p_2 = R * point - R_2 * two.SupportPoint(-R_2.transpose() * n);
      const Separation at = FindSeparation({&one, R, Vector3::Zero()}, {&two, R_2, p_2}, &n);
      distance = std::max<Long>(distance, std::abs(at.distance) / (1 + p_2.norm()));
      normal = std::max<Long>(normal, (at.nu - n).norm());
    }
    Print("axis_ratio", "contact point", k, x);
    Print("axis_ratio", "S", k, S);
    Print("axis_ratio", "velocity over the surface", k, rolling);
    Print("axis_ratio", "the same by (B - x x^T)/s", k, naive);
    if (exponent > 3.01) continue;
    Print("pairs", "distance / size", k, distance);
    Print("pairs", "normal (rad)", k, normal);
  }
}

void Size(Random* random) {
  for (double exponent = -150; exponent <= 150.1; exponent += 25) {
    const double size = std::pow(10, exponent);
    Long S = 0, fourth = 0;
    for (int i = 0; i < kCases; ++i) {
      const Vector3 shape(1, random->Uniform(0.1, 1), random->Uniform(0.1, 1)), nu = random->Unit(), u = random->Unit();
      const Exact exact = Ellipsoidal(shape, nu, u);
      S = std::max(S, Relative(Matrix3(Ellipsoid(size * shape).SupportHessian(nu) / size), exact.S));
      const Matrix3 one = Ellipsoid(shape).SupportFourth(nu, u, u);
      const Matrix3 scaled = Ellipsoid(size * shape).SupportFourth(nu, u, u) / size;
      fourth = std::max(fourth, Relative(scaled, one.cast<Long>()));
    }
    Print("size", "S", size, S);
    Print("size", "Q against the body of size 1", size, fourth);
  }
  for (double exponent = 0; exponent <= 9.1; exponent += 1) {
    const double away = std::pow(10, exponent);
    Long gap = 0;
    for (int i = 0; i < kCases; ++i) {
      PlacedSurface surface{Ellipsoid({1, 0.5, 0.3}), Vector3::Zero(), Matrix3::Identity()};
      FrameMotion body, ground;
      PlacedPlane plane;
      plane.n_B = random->Unit();
      body.p_WB = away * random->Unit();
      const Exact exact = Ellipsoidal({1, 0.5, 0.3}, -plane.n_B, {1, 0, 0});
      const Long expected = plane.n_B.cast<Long>().dot(body.p_WB.cast<Long>()) - exact.h;
      gap = std::max(gap, std::abs(ComputePlaneContact(surface, body, plane, ground).gap - expected));
    }
    Print("gap", "absolute error (m)", away, gap);
  }
}

// A top: spin about the normal grows, what moves the contact point stays.
void Speed(Random* random) {
  for (double exponent = 0; exponent <= 12.1; exponent += 1) {
    const double spin = std::pow(10, exponent);
    Long stable = 0, subtracted = 0;
    for (int i = 0; i < kCases; ++i) {
      const Vector3 axes(1, random->Uniform(0.2, 1), random->Uniform(0.2, 1)), nu = random->Unit();
      const Vector3 omega = spin * nu + nu.cross(random->Unit());
      const Exact exact = Ellipsoidal(axes, nu, omega);
      const Ellipsoid body(axes);
      stable = std::max(stable, Relative(body.RollingVelocity(nu, omega), exact.x_rel));
      const Vector3 tangent = omega - omega.dot(nu) * nu;
      subtracted = std::max(subtracted, Relative(Vector3(body.SupportHessian(nu) * nu.cross(tangent)), exact.x_rel));
    }
    Print("speed", "double cross product", spin, stable);
    Print("speed", "spin subtracted", spin, subtracted);
  }
}

// x and S of superellipsoids with one exponent against the plain p-norm in long double.
void Exponent(Random* random) {
  for (const double exponent : {0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.3, 1.5, 1.6, 1.7, 1.8, 1.9, 1.95}) {
    const double q_double = 2 / (2 - exponent);
    const Long q = q_double;
    Long x = 0, S = 0;
    for (int i = 0; i < kCases; ++i) {
      const Vector3 axes(1, random->Uniform(0.2, 1), random->Uniform(0.2, 1)), nu = random->Unit();
      const LongVector a = axes.cast<Long>(), t = a.cwiseProduct(nu.cast<Long>()).cwiseAbs();
      Long sum = 0;
      for (int k = 0; k < 3; ++k) sum += std::pow(t[k], q);
      const Long h = std::pow(sum, 1 / q);
      LongVector point;
      LongMatrix hessian;
      for (int k = 0; k < 3; ++k) point[k] = std::copysign(a[k], nu[k]) * std::pow(t[k] / h, q - 1);
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
          const Long others = (std::pow(t[(k + 1) % 3], q) + std::pow(t[(k + 2) % 3], q)) / sum;
          hessian(k, l) = k == l ? (q - 1) / h * a[k] * a[k] * std::pow(t[k] / h, q - 2) * others
                                 : -(q - 1) / h * point[k] * point[l];
        }
      }
      const Superellipsoid body(axes, exponent, exponent);
      x = std::max(x, Relative(body.SupportPoint(nu), point));
      S = std::max(S, Relative(body.SupportHessian(nu), hessian));
    }
    Print("exponent", "contact point", exponent, x);
    Print("exponent", "S", exponent, S);
  }
}

}  // namespace
}  // namespace rollgait

int main() {
  std::puts("plot,series,x,y");
  rollgait::Random random;
  rollgait::AxisRatio(&random);
  rollgait::Size(&random);
  rollgait::Speed(&random);
  rollgait::Exponent(&random);
  return 0;
}
