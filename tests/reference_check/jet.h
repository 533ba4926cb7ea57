#ifndef ROLLGAIT_TESTS_REFERENCE_CHECK_JET_H_
#define ROLLGAIT_TESTS_REFERENCE_CHECK_JET_H_

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>

namespace rollgait::reference {

// A number with its first and second derivatives with respect to N variables.
template <int N>
struct Jet {
  double v = 0;
  Eigen::Matrix<double, N, 1> d = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> dd = Eigen::Matrix<double, N, N>::Zero();

  Jet() = default;
  Jet(double value) : v(value) {}  // NOLINT: a constant
  static Jet Variable(double value, int index) {
    Jet jet(value);
    jet.d[index] = 1;
    return jet;
  }

  friend Jet operator+(Jet a, const Jet& b) {
    a.v += b.v, a.d += b.d, a.dd += b.dd;
    return a;
  }
  friend Jet operator-(Jet a, const Jet& b) {
    a.v -= b.v, a.d -= b.d, a.dd -= b.dd;
    return a;
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet c(a.v * b.v);
    c.d = a.v * b.d + b.v * a.d;
    const Eigen::Matrix<double, N, N> mixed = a.d * b.d.transpose();
    c.dd = a.v * b.dd + b.v * a.dd + mixed + mixed.transpose();
    return c;
  }
};

// Three of them.
template <int N>
struct Jet3 {
  std::array<Jet<N>, 3> e;

  Jet3() = default;
  Jet3(const Eigen::Vector3d& u) : e{u[0], u[1], u[2]} {}  // NOLINT: a constant
  Jet<N>& operator[](int i) { return e[i]; }
  const Jet<N>& operator[](int i) const { return e[i]; }

  friend Jet3 operator+(const Jet3& a, const Jet3& b) { return Make(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
  friend Jet3 operator-(const Jet3& a, const Jet3& b) { return Make(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
  friend Jet3 operator*(const Jet<N>& s, const Jet3& a) { return Make(s * a[0], s * a[1], s * a[2]); }
  friend Jet3 operator*(const Eigen::Matrix3d& m, const Jet3& a) {
    Jet3 result;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) result[i] = result[i] + Jet<N>(m(i, j)) * a[j];
    }
    return result;
  }
  static Jet3 Make(const Jet<N>& x, const Jet<N>& y, const Jet<N>& z) {
    Jet3 result;
    result[0] = x, result[1] = y, result[2] = z;
    return result;
  }
  Eigen::Vector3d Value() const { return {e[0].v, e[1].v, e[2].v}; }
  Eigen::Vector3d First(int i) const { return {e[0].d[i], e[1].d[i], e[2].d[i]}; }
  Eigen::Vector3d Second(int i, int j) const { return {e[0].dd(i, j), e[1].dd(i, j), e[2].dd(i, j)}; }
};

template <int N>
Jet3<N> Cross(const Jet3<N>& a, const Jet3<N>& b) {
  return Jet3<N>::Make(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

// y with A y = c, by differentiating the system twice; A is symmetric and its entries are jets.
template <int N>
Jet3<N> Solve(const std::array<Jet3<N>, 3>& A, const Jet3<N>& c) {
  Eigen::Matrix3d A_0;
  std::array<Eigen::Matrix3d, N> A_i;
  const auto row = [&](int r) -> const Jet3<N>& { return A[r]; };
  for (int r = 0; r < 3; ++r) {
    A_0.row(r) = row(r).Value().transpose();
    for (int i = 0; i < N; ++i) A_i[i].row(r) = row(r).First(i).transpose();
  }
  const Eigen::PartialPivLU<Eigen::Matrix3d> lu(A_0);
  const Eigen::Vector3d y = lu.solve(c.Value());
  std::array<Eigen::Vector3d, N> y_i;
  Jet3<N> result(y);
  for (int i = 0; i < N; ++i) {
    y_i[i] = lu.solve(c.First(i) - A_i[i] * y);
    for (int r = 0; r < 3; ++r) result[r].d[i] = y_i[i][r];
  }
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) {
      Eigen::Matrix3d A_ij;
      for (int r = 0; r < 3; ++r) A_ij.row(r) = row(r).Second(i, j).transpose();
      const Eigen::Vector3d y_ij = lu.solve(c.Second(i, j) - A_ij * y - A_i[i] * y_i[j] - A_i[j] * y_i[i]);
      for (int r = 0; r < 3; ++r) result[r].dd(i, j) = result[r].dd(j, i) = y_ij[r];
    }
  }
  return result;
}

}  // namespace rollgait::reference

#endif  // ROLLGAIT_TESTS_REFERENCE_CHECK_JET_H_
