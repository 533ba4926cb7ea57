#include "core/geometry/implicit_surface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/base/check.h"
#include "core/geometry/jet_values.h"

namespace rollgait {
namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kSmallest = 1e-9, kLargest = 1e9;  // m, of a surface
// A radius of curvature this many sizes long is flat for double precision.
constexpr double kFlat = 1e14;

// Distance t > 0 along the unit direction with Φ(t u) = 0, or 0 if there is none in the admissible range.
double RayLength(const ConvexFunction& function, const Vector3& u) {
  double inside = 0, outside = kSmallest;
  while (function.Value(outside * u) < 0) {
    inside = outside;
    outside *= 4;
    if (outside > kLargest) return 0;
  }
  for (int i = 0; i < 200 && outside - inside > kEpsilon * outside; ++i) {
    const double middle = 0.5 * (inside + outside);
    (function.Value(middle * u) < 0 ? inside : outside) = middle;
  }
  return outside < 1.5 * kSmallest ? 0 : outside;
}

// The bordered system [H, −ν; gᵀ, 0] (y, η) = (upper, lower), with lengths in units of `size` and η in units of κ, so
// that its pivots can be compared.
class Bordered {
 public:
  Bordered(const Matrix3& hessian, const Vector3& gradient, const Vector3& nu, double kappa, double size)
      : size_(size), kappa_(kappa) {
    Matrix4 K = Matrix4::Zero();
    if (hessian.allFinite()) K << size * size * hessian, -kappa * size * nu, size * gradient.transpose(), 0;
    lu_.compute(K);
  }
  bool invertible() const { return lu_.isInvertible(); }
  Vector4 Solve(const Vector3& upper, double lower) const {
    Vector4 right;
    right << size_ * upper, lower;
    Vector4 y = lu_.solve(right);
    y.head<3>() *= size_;
    y[3] *= kappa_;
    return y;
  }

 private:
  double size_, kappa_;
  Eigen::FullPivLU<Matrix4> lu_;
};

std::string Text(const char* format, double a, double b, double c, double d) {
  char text[300];
  std::snprintf(text, sizeof(text), format, a, b, c, d);
  return text;
}

// What is wrong with Φ along one ray, or nothing.
std::string Complaint(const ConvexFunction& function, const Vector3& u, double* length) {
  *length = RayLength(function, u);
  if (*length == 0) {
    return Text(
        "Φ has no zero between 1e-9 m and 1e9 m along the ray (%g, %g, %g) from the origin; the body must be "
        "bounded and contain the origin.",
        u.x(), u.y(), u.z(), 0);
  }
  const Vector3 x = *length * u;
  const Vector3 gradient = function.Gradient(x);
  const Matrix3 hessian = function.Hessian(x);
  if (!gradient.allFinite() || !(gradient.dot(u) > 0)) {
    return Text("The gradient of Φ at (%g, %g, %g) m is not finite or does not point outwards.", x.x(), x.y(), x.z(),
                0);
  }
  const double step = 1e-5 * *length;
  for (int i = 0; i < 3; ++i) {
    const Vector3 e = step * Vector3::Unit(i);
    const double difference = (function.Value(x + e) - function.Value(x - e)) / (2 * step);
    if (!(std::abs(difference - gradient[i]) <= 1e-4 * gradient.norm() + 1e-9 * hessian.norm() * *length)) {
      return Text("The gradient of Φ at (%g, %g, %g) m differs from differences of Φ by %g.", x.x(), x.y(), x.z(),
                  difference - gradient[i]);
    }
  }
  if (!hessian.allFinite()) return "";  // an edge: allowed, S has an eigenvalue 0 there
  const double least = Eigen::SelfAdjointEigenSolver<Matrix3>(hessian, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(least >= -1e-9 * hessian.norm())) {
    return Text("The Hessian of Φ at (%g, %g, %g) m has the eigenvalue %g; Φ must be convex.", x.x(), x.y(), x.z(),
                least);
  }
  return "";
}

}  // namespace

Result<ImplicitSurface> ImplicitSurface::Create(std::shared_ptr<const ConvexFunction> function,
                                                const std::string& field) {
  if (function == nullptr) return Violations{{field, "There is no function."}};
  const double centre = function->Value(Vector3::Zero());
  if (!(centre < 0)) {
    return Violations{
        {field, Text("Φ is %g at the origin; it must be negative: the origin lies inside.", centre, 0, 0, 0)}};
  }
  double size = 0;
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
    const Vector3 direction(x, y, z);
    if (direction.isZero(0)) continue;
    double length = 0;
    const std::string complaint = Complaint(*function, direction.normalized(), &length);
    if (!complaint.empty()) return Violations{{field, complaint}};
    size = std::max(size, length);
  }
  return ImplicitSurface(std::move(function), size);
}

ImplicitSurface::ImplicitSurface(std::shared_ptr<const ConvexFunction> function, double size)
    : function_(std::move(function)), size_(size) {}

double ImplicitSurface::Residual(const Vector3& nu, const Contact& contact) const {
  return (function_->Gradient(contact.x) - contact.kappa * nu).norm() * size_ + std::abs(function_->Value(contact.x));
}

bool ImplicitSurface::Polish(const Vector3& nu, Contact* contact) const {
  double residual = Residual(nu, *contact);
  double last_step = kInfinity;
  for (int i = 0; i < 50; ++i) {
    const Vector3 gradient = function_->Gradient(contact->x);
    const Matrix3 hessian = function_->Hessian(contact->x);
    if (!hessian.allFinite()) return false;
    const Vector4 step = Bordered(hessian, gradient, nu, contact->kappa, size_)
                             .Solve(contact->kappa * nu - gradient, -function_->Value(contact->x));
    const double length = step.head<3>().norm();
    if (!step.allFinite()) return residual <= 64 * kEpsilon * contact->kappa * size_;
    Contact next;
    double next_residual = kInfinity;
    double part = 1;
    for (; part > 1e-3; part /= 2) {
      next = {contact->x + part * step.head<3>(), contact->kappa + part * step[3]};
      next_residual = next.kappa > 0 ? Residual(nu, next) : kInfinity;
      if (next_residual < residual) break;
    }
    const bool small = length <= 1e-7 * size_;
    if (!(next_residual < residual)) return small && residual <= 1e-9 * contact->kappa * size_;
    *contact = next;
    residual = next_residual;
    if (length <= 2 * kEpsilon * size_ || residual == 0 || (small && length > 0.25 * last_step)) return true;
    last_step = part * length;
  }
  return false;
}

void ImplicitSurface::Minimise(const Vector3& nu, Contact* contact) const {
  const auto value = [&](const Vector3& x) { return function_->Value(x) - contact->kappa * nu.dot(x); };
  double now = value(contact->x);
  for (int i = 0; i < 500; ++i) {
    const Vector3 gradient = function_->Gradient(contact->x) - contact->kappa * nu;
    Matrix3 hessian = function_->Hessian(contact->x);
    if (!hessian.allFinite()) hessian.setZero();
    hessian.diagonal().array() += 1e-10 * hessian.trace() + 1e-6 * gradient.norm() / size_;
    const Vector3 step = -hessian.fullPivLu().solve(gradient);
    const double slope = gradient.dot(step);
    if (!(slope < 0) || gradient.norm() <= 1e-12 * contact->kappa) return;
    double part = std::min(1.0, size_ / step.norm());
    double next = value(contact->x + part * step);
    for (; !(next <= now + 1e-4 * part * slope); next = value(contact->x + part * step)) {
      part /= 2;
      if (part < 1e-12) return;
    }
    contact->x += part * step;
    now = next;
  }
}

ImplicitSurface::Contact ImplicitSurface::Solve(const Vector3& nu) const {
  Contact start;
  start.x = RayLength(*function_, nu) * nu;
  start.kappa = function_->Gradient(start.x).norm();
  Contact contact = start;
  if (Polish(nu, &contact)) return contact;

  // Φ at the minimum grows with κ: bracket its zero, bisect, and polish whenever that works.
  Contact low = start, high = start;
  Minimise(nu, &high);
  while (function_->Value(high.x) < 0 && high.kappa < start.kappa * 1e12) {
    low = high;
    high.kappa *= 4;
    Minimise(nu, &high);
  }
  if (low.kappa == high.kappa) {
    low.x.setZero();
    low.kappa = 0;
  }
  for (int i = 0; i < 200 && high.kappa - low.kappa > 2 * kEpsilon * high.kappa; ++i) {
    contact = high;
    if (Polish(nu, &contact)) return contact;
    contact.kappa = low.kappa > 0 ? std::sqrt(low.kappa * high.kappa) : high.kappa / 16;
    contact.x = high.x;
    Minimise(nu, &contact);
    (function_->Value(contact.x) < 0 ? low : high) = contact;
  }
  return high;
}

Vector3 ImplicitSurface::SupportPoint(const Vector3& nu) const { return Solve(nu / nu.norm()).x; }

Matrix3 ImplicitSurface::SupportHessian(const Vector3& nu) const { return HessianByJet(*this, nu); }

Vector3 ImplicitSurface::RollingVelocity(const Vector3& nu, const Vector3& omega) const {
  return RollingVelocityByJet(*this, nu, omega);
}

void ImplicitSurface::Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
  const double length = nu.norm();
  const Contact contact = Solve(nu / length);
  const double kappa = contact.kappa / length;  // ∇Φ = κ ν for the ν that was given
  const Vector3 x = contact.x;
  jet->x = x;
  jet->h = nu.dot(x);
  jet->order = std::min(order, function_->derivatives());
  if (order < 2) return;
  const Vector3 gradient = function_->Gradient(x);
  const Matrix3 H = function_->Hessian(x);
  const Bordered K(H, gradient, nu, kappa, size_);
  const auto solve = [&](const Vector3& upper, double lower) { return K.Solve(upper, lower); };
  // First derivatives with respect to ν_i: columns (x_i, κ_i). Then pairs (i ≤ j), then triples.
  Vector3 x_i[3], x_ij[6];
  double kappa_i[3], kappa_ij[6];
  for (int i = 0; i < 3; ++i) {
    const Vector4 y = solve(kappa * Vector3::Unit(i), 0);
    x_i[i] = y.head<3>();
    kappa_i[i] = y[3];
    jet->S.col(i) = x_i[i];
  }
  jet->S = (0.5 * (jet->S + jet->S.transpose())).eval();
  if (!K.invertible() || !(jet->S.norm() * length < kFlat * size_)) jet->order = 1;
  if (jet->order < 3) {
    jet->MarkMissing(order);
    return;
  }

  const auto pair = [](int i, int j) { return SupportJet::PairIndex(i, j); };
  Matrix3 third[3];  // D³Φ[x_i]
  for (int i = 0; i < 3; ++i) third[i] = function_->Third(x, x_i[i]);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const Vector4 y = solve(kappa_i[j] * Vector3::Unit(i) + kappa_i[i] * Vector3::Unit(j) - third[i] * x_i[j],
                              -x_i[i].dot(H * x_i[j]));
      x_ij[pair(i, j)] = y.head<3>();
      kappa_ij[pair(i, j)] = y[3];
      for (int k = j; k < 3; ++k) {
        const int ijk[] = {i, j, k};
        jet->SetThird(ijk, y[k]);
      }
    }
  }
  for (int i = 0; order >= 4 && jet->order >= 4 && i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const Matrix3 fourth = function_->Fourth(x, x_i[i], x_i[j]);
      for (int k = j; k < 3; ++k) {
        const Vector3 &ij = x_ij[pair(i, j)], &ik = x_ij[pair(i, k)], &jk = x_ij[pair(j, k)];
        const Vector3 upper = kappa_ij[pair(i, j)] * Vector3::Unit(k) + kappa_ij[pair(i, k)] * Vector3::Unit(j) +
                              kappa_ij[pair(j, k)] * Vector3::Unit(i) - fourth * x_i[k] - third[j] * ik -
                              third[i] * jk - third[k] * ij;
        const double lower =
            -(x_i[i].dot(third[j] * x_i[k]) + ik.dot(H * x_i[j]) + jk.dot(H * x_i[i]) + ij.dot(H * x_i[k]));
        const Vector4 y = solve(upper, lower);
        for (int l = k; l < 3; ++l) {
          const int ijkl[] = {i, j, k, l};
          jet->SetFourth(ijkl, y[l]);
        }
      }
    }
  }
  jet->MarkMissing(order);
}

}  // namespace rollgait
