// Second derivatives of every row of inverse dynamics. Row l of  λᵀ ID  is λ = e_l: then W is S_l beyond joint l, and
// the formulas of AddContractedHessian are bilinear in two axes of one path for given composites of the deepest joint:
//   joint l the deepest, for k, m on its path:  M_l x = 2 (x_ω × P_ω + x_v × P_v) + Eᵀ x_ω  with P = I_l S_l,
//   joint k the deepest, for l before k and m on the path:  the same as a matrix on S_l in place of x, and the change
//   of the composite's inertia as it moves along S_k,  İ_k = S_k ×* I_k − I_k S_k ×.

#include "core/multibody/tree_dynamics.h"

namespace rollgait {
namespace {

using Four = Eigen::Array<double, 4, 1>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr int kAxis = 0, kPsi = 6, kPsi2 = 12;  // first rows of a path's S, ψ̇, ψ̈

// Σ_c coefficients(c) row_(first + c) of four columns of a path.
template <int kSize>
Four Combine(const Eigen::Matrix<double, kSize, 1>& coefficients, const RowMajorMatrix& path, int first, int column) {
  const double* row = path.data() + first * path.cols() + column;
  Four sum = coefficients(0) * Eigen::Map<const Four>(row);
  for (int c = 1; c < kSize; ++c) sum += coefficients(c) * Eigen::Map<const Four>(row += path.cols());
  return sum;
}

// Where the matrices of row l begin.
struct Targets {
  Targets(int l, RowHessians* rows)
      : qq(rows->qq.col(l * rows->n).data()),
        qv(rows->qv.col(l * rows->n).data()),
        qa(rows->qa.col(l * rows->n).data()),
        vv(rows->vv.col(l * rows->n).data()) {}
  double *const qq, *const qv, *const qa, *const vv;
};

// How the inertia about the world origin changes when its bodies move along s.
SpatialInertia Rate(const SpatialInertia& inertia, const Vector6& s) {
  const Vector3 w = s.head<3>(), v = s.tail<3>();
  SpatialInertia rate;
  rate.moment = inertia.mass * v + w.cross(inertia.moment);
  const Matrix3 half = Skew(w) * inertia.rotational - Skew(v) * Skew(inertia.moment);
  rate.rotational = half + half.transpose();
  return rate;
}

// The matrix of  S_l ↦ 2 (x_ω × P_ω + x_v × P_v) + Eᵀ x_ω  with P and E of this inertia moving along S_l.
Matrix36 VirtualMatrix(const SpatialInertia& inertia, const Vector6& x) {
  const Vector3 w = x.head<3>();
  const Matrix3 W = Skew(w), V = Skew(x.tail<3>()), H = Skew(inertia.moment);
  Matrix36 m;
  m.leftCols<3>() =
      2 * (W * inertia.rotational - V * H) + Skew(2 * (inertia.rotational * w) - inertia.rotational.trace() * w);
  m.rightCols<3>() = 2 * (W * H - H * W + inertia.mass * V);
  return m;
}

}  // namespace

void TreeDynamics::SecondDerivatives(RowHessians* rows) {
  UpdateComposites();
  for (Path& path : paths_) {
    const int stride = static_cast<int>(path.vectors.cols());
    double* column = path.vectors.data();
    for (const int m : path.joints) {
      for (int c = 0; c < 6; ++c) {
        column[(kAxis + c) * stride] = axis_[m](c);
        column[(kPsi + c) * stride] = psi_[m](c);
        column[(kPsi2 + c) * stride] = psi2_[m](c);
      }
      ++column;
    }
  }
  for (int k = 0; k < n_; ++k) {
    DifferentiateRow(k, rows);
    DifferentiateRowsBefore(k, rows);
  }
}

// Row l by the joints on its own path.
void TreeDynamics::DifferentiateRow(int l, RowHessians* rows) {
  const Composite& composite = composite_[l];
  const Vector6 momentum = composite.inertia * axis_[l];
  const Vector3 z = composite.motion.ApplyTranspose(axis_[l]).head<3>(), w = axis_[l].head<3>();
  // Eᵀ x = 2 h × (S_v × x) − S_ω × (2 J − tr J) x
  Matrix3 k_matrix = 2 * composite.inertia.rotational;
  k_matrix.diagonal().array() -= composite.inertia.rotational.trace();
  Matrix36 virtual_matrix;
  virtual_matrix.leftCols<3>() =
      2 * Skew(composite.inertia.moment) * Skew(axis_[l].tail<3>()) - Skew(w) * k_matrix - 2 * Skew(momentum.head<3>());
  virtual_matrix.rightCols<3>() = -2 * Skew(momentum.tail<3>());

  const Path& path = paths_[path_of_[l]];
  const Targets to(l, rows);
  for (int depth = 0; depth <= depth_[l]; ++depth) {
    const int k = path.joints[depth];
    const Vector3 v_psi = virtual_matrix * axis_[k];
    const Vector3 q_psi = virtual_matrix * psi_[k] + axis_[k].head<3>().cross(z);
    const Vector6 q_psi2 = CrossForce(axis_[k], momentum), doubled = 2 * q_psi2;
    for (int column = 0; column <= depth; column += 4) {
      const Four by_qq = Combine(q_psi, path.vectors, kPsi, column) + Combine(q_psi2, path.vectors, kPsi2, column);
      const Four by_vv = Combine(v_psi, path.vectors, kAxis, column);
      const Four by_mk = Combine(v_psi, path.vectors, kPsi, column);
      const Four by_km = Combine(q_psi, path.vectors, kAxis, column) + Combine(doubled, path.vectors, kPsi, column);
      const Four by_a = Combine(q_psi2, path.vectors, kAxis, column);
      for (int i = 0; i < 4 && column + i <= depth; ++i) {
        const int m = path.joints[column + i];
        const int km = k + m * n_, mk = m + k * n_;
        to.qq[km] = to.qq[mk] = by_qq(i);
        to.vv[km] = to.vv[mk] = by_vv(i);
        to.qv[km] = by_km(i);
        to.qv[mk] = by_mk(i);
        to.qa[km] = by_a(i);
      }
    }
  }
}

// Rows of the joints before k, by k and the joints on its path.
void TreeDynamics::DifferentiateRowsBefore(int k, RowHessians* rows) {
  const Composite& composite = composite_[k];
  const Vector6& s = axis_[k];
  const Vector3 w = s.head<3>(), v = s.tail<3>();
  const SpatialInertia rate = Rate(composite.inertia, s);
  const Matrix36 by_v = VirtualMatrix(composite.inertia, s);
  Matrix36 by_q = VirtualMatrix(composite.inertia, psi_[k]);
  {
    // Bᵀ (S_l × S_k) + S_k × Bᵀ S_l
    const Matrix3 b = composite.motion.coriolis.transpose(), W = Skew(w), p = Skew(2 * composite.motion.momentum);
    by_q.leftCols<3>() += W * b - b * W - p * Skew(v);
    by_q.rightCols<3>() += W * p - p * W;
  }
  const Vector6 a_omega = composite.inertia * s;
  const Vector6 v_omega = 2 * (composite.inertia * psi_[k]) + composite.motion.Apply(s);
  const Vector6 q_omega = CrossForce(s, force_[k]) + composite.inertia * psi2_[k] + composite.motion.Apply(psi_[k]);

  const Path& path = paths_[path_of_[k]];
  const Targets to(0, rows);
  for (int depth = 0; depth <= depth_[k]; ++depth) {
    const int m = path.joints[depth];
    const Vector6 on_qq = by_q.transpose() * psi_[m].head<3>() + rate * psi2_[m];
    const Vector6 on_vv = by_v.transpose() * axis_[m].head<3>();
    const Vector6 on_mk = by_v.transpose() * psi_[m].head<3>();
    const Vector6 on_km = by_q.transpose() * axis_[m].head<3>() + 2 * (rate * psi_[m]);
    const Vector6 on_a = rate * axis_[m];
    // Of rows before m: x · (S_l × S_m)
    const Vector6 cross_qq = CrossForce(axis_[m], q_omega), cross_mk = CrossForce(axis_[m], v_omega),
                  cross_a = CrossForce(axis_[m], a_omega);
    for (int column = 0; column < depth_[k]; column += 4) {
      Four by_qq = Combine(on_qq, path.vectors, kAxis, column), by_mk = Combine(on_mk, path.vectors, kAxis, column);
      const Four by_vv = Combine(on_vv, path.vectors, kAxis, column);
      const Four by_km = Combine(on_km, path.vectors, kAxis, column);
      const Four by_a = Combine(on_a, path.vectors, kAxis, column);
      Four by_am = Four::Zero();
      if (column < depth) {
        const Four before = (Four(0, 1, 2, 3) + column < depth).select(Four::Ones(), Four::Zero());
        by_qq += before * Combine(cross_qq, path.vectors, kAxis, column);
        by_mk += before * Combine(cross_mk, path.vectors, kAxis, column);
        by_am = before * Combine(cross_a, path.vectors, kAxis, column);
      }
      for (int i = 0; i < 4 && column + i < depth_[k]; ++i) {
        const int l = path.joints[column + i];
        const int row = l * n_ * n_, km = row + k + m * n_, mk = row + m + k * n_;
        to.qq[km] = to.qq[mk] = by_qq(i);
        to.vv[km] = to.vv[mk] = by_vv(i);
        to.qv[km] = by_km(i);
        to.qv[mk] = by_mk(i);
        to.qa[km] = by_a(i);
        to.qa[mk] = by_am(i);
      }
    }
  }
}

}  // namespace rollgait
