#ifndef ROLLGAIT_TESTS_SUPPORT_FORMULA_H_
#define ROLLGAIT_TESTS_SUPPORT_FORMULA_H_

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/ocp/point_function.h"
#include "tests/support/jet.h"

namespace rollgait {

// The variables of one instant in a formula.
class FormulaPoint {
 public:
  FormulaPoint(const PointLayout& layout, const double* z) : layout_(layout) {
    ROLLGAIT_CHECK(layout.size() <= Jet::kVariables);
    for (int i = 0; i < layout.size(); ++i) z_.push_back(Jet::Variable(z[i], i));
  }
  const Jet& q(int i) const { return z_[static_cast<size_t>(layout_.q() + i)]; }
  const Jet& v(int i) const { return z_[static_cast<size_t>(layout_.v() + i)]; }
  const Jet& a(int i) const { return z_[static_cast<size_t>(layout_.a() + i)]; }
  const Jet& u(int i) const { return z_[static_cast<size_t>(layout_.tau() + i)]; }

 private:
  PointLayout layout_;
  std::vector<Jet> z_;
};

// Pairs of positions, velocities and efforts.
inline Entries AllPairsWithoutAccelerations(const PointLayout& layout) {
  Entries entries;
  for (int i = 0; i < layout.size(); ++i) {
    for (int j = 0; j <= i; ++j) {
      const auto is_acceleration = [&layout](int k) { return k >= layout.a() && k < layout.tau(); };
      if (!is_acceleration(i) && !is_acceleration(j)) entries.emplace_back(j, i);
    }
  }
  return entries;
}

// Of a function whose second derivatives by accelerations are zero; refuses one whose are not.
inline void AddFormulaHessian(const PointLayout& layout, const Jet& jet, double factor, Eigen::Ref<MatrixX> hessian) {
  const int m = layout.size(), n = layout.n;
  ROLLGAIT_CHECK(jet.hessian.block(layout.a(), 0, n, m).isZero(0));
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < m; ++i) {
      const auto block = [&layout](int k) { return k < layout.tau() ? k / layout.n : 3; };
      if (block(i) <= block(j)) hessian(i, j) += factor * jet.hessian(i, j);
    }
  }
}

// Rows of motion a = f(q, v, u), by the formula of f.
class FormulaOfMotion : public PointConstraint {
 public:
  using Accelerations = std::function<std::vector<Jet>(const FormulaPoint&)>;
  FormulaOfMotion(const PointLayout& layout, Accelerations f) : layout_(layout), f_(std::move(f)) {}

  int rows() const override { return layout_.n; }
  std::string Name(int row) const override { return "motion " + std::to_string(row); }
  std::string Unit(int) const override { return ""; }
  double Size(int) const override { return 1; }
  void Bounds(double, double* lower, double* upper) const override {
    std::fill_n(lower, rows(), 0.0);
    std::fill_n(upper, rows(), 0.0);
  }
  Entries JacobianPattern() const override {
    Entries entries;
    for (int row = 0; row < rows(); ++row) {
      for (int column = 0; column < layout_.size(); ++column) entries.emplace_back(row, column);
    }
    return entries;
  }
  Entries HessianPattern() const override { return AllPairsWithoutAccelerations(layout_); }
  void Value(const PointContext& at, double* g) override {
    for (const Jet& row : Rows(at)) *g++ = row.value;
  }
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override {
    int r = 0;
    for (const Jet& row : Rows(at)) jacobian.row(r++) = row.gradient.head(layout_.size()).transpose();
  }
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override {
    for (const Jet& row : Rows(at)) AddFormulaHessian(layout_, row, *lambda++, hessian);
  }

 private:
  std::vector<Jet> Rows(const PointContext& at) const {
    const FormulaPoint point(layout_, at.z);
    std::vector<Jet> rows = f_(point);
    ROLLGAIT_CHECK(static_cast<int>(rows.size()) == layout_.n);
    for (int i = 0; i < layout_.n; ++i) {
      rows[static_cast<size_t>(i)] = point.a(i) - rows[static_cast<size_t>(i)];
    }
    return rows;
  }
  PointLayout layout_;
  Accelerations f_;
};

// An integrand by its formula.
class FormulaCost : public PointCost {
 public:
  using Integrand = std::function<Jet(const FormulaPoint&)>;
  FormulaCost(const PointLayout& layout, double typical, Integrand l)
      : layout_(layout), typical_(typical), l_(std::move(l)) {}

  double Typical() const override { return typical_; }
  Entries HessianPattern() const override { return AllPairsWithoutAccelerations(layout_); }
  double Value(const PointContext& at) override { return l_({layout_, at.z}).value; }
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override {
    gradient += weight * l_({layout_, at.z}).gradient.head(layout_.size());
  }
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override {
    AddFormulaHessian(layout_, l_({layout_, at.z}), weight, hessian);
  }

 private:
  PointLayout layout_;
  double typical_;
  Integrand l_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_FORMULA_H_
