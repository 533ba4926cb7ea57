// The interior point method of core/nlp on programs whose answers are known, with Ipopt for comparison.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <random>
#include <vector>

#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "tests/core/nlp/suite/measure.h"
#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {

// gtest prints parameters by it.
static void PrintTo(const SuiteRow& row, std::ostream* out) { *out << row.name; }

namespace {

class NlpSuite : public ::testing::TestWithParam<SuiteRow> {
 protected:
  const Answer& answer() const { return GetParam().answer; }
};

// A dense matrix of a pattern's values.
MatrixX Dense(int rows, int columns, const SparsityPattern& pattern, const VectorX& values) {
  MatrixX dense = MatrixX::Zero(rows, columns);
  for (int e = 0; e < pattern.size(); ++e) dense(pattern.rows[e], pattern.columns[e]) += values(e);
  return dense;
}

// Derivatives of a program as matrices, and what they are derivatives of.
struct Derivatives {
  explicit Derivatives(NlpProblem& problem) : program(problem) {}
  VectorX Functions(const VectorX& x) const {
    VectorX y(1 + program.constraints());
    EXPECT_TRUE(program.Objective(x.data(), y.data()) && program.Constraints(x.data(), y.data() + 1));
    return y;
  }
  MatrixX First(const VectorX& x) const {
    VectorX gradient(program.variables()), values(program.jacobian_pattern().size());
    EXPECT_TRUE(program.Gradient(x.data(), gradient.data()) && program.Jacobian(x.data(), values.data()));
    MatrixX first(1 + program.constraints(), program.variables());
    first.row(0) = gradient.transpose();
    first.bottomRows(program.constraints()) =
        Dense(program.constraints(), program.variables(), program.jacobian_pattern(), values);
    return first;
  }
  // Of the sum of the functions with these weights.
  MatrixX Second(const VectorX& x, const VectorX& weights) const {
    VectorX values(program.hessian_pattern().size());
    EXPECT_TRUE(program.Hessian(x.data(), weights(0), weights.data() + 1, values.data()));
    const MatrixX lower = Dense(program.variables(), program.variables(), program.hessian_pattern(), values);
    const VectorX diagonal = lower.diagonal();
    return lower + lower.transpose() - MatrixX(diagonal.asDiagonal());
  }
  NlpProblem& program;
};

// Central differences of order 4 with steps of 1e-3 (relative where x is large) are off by 1e-12 of the fifth
// derivative and by 1e-13 of the function: of all that is summed, 1e-7 is far beyond both, and far below an error in a
// formula.
template <typename Function>
MatrixX Differences(const Function& function, const VectorX& x) {
  MatrixX columns(function(x).size(), x.size());
  for (int i = 0; i < x.size(); ++i) {
    const double h = 1e-3 * std::max(1.0, std::abs(x(i)));
    const auto at = [&](double steps) {
      VectorX moved = x;
      moved(i) += steps * h;
      return VectorX(function(moved));
    };
    columns.col(i) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  }
  return columns;
}

TEST_P(NlpSuite, DerivativesAreThoseOfDifferences) {
  const auto program = GetParam().make();
  const Derivatives derivatives(*program);
  std::mt19937 engine(1);
  const auto random = [&engine] { return 2 * (engine() / 4294967296.0) - 1; };
  VectorX x = StartOf(GetParam()).x, weights(1 + program->constraints());
  for (int i = 0; i < x.size(); ++i) x(i) += 0.02 * random() * std::max(1.0, std::abs(x(i)));
  for (int r = 0; r < weights.size(); ++r) weights(r) = random();
  const double size = derivatives.Functions(x).lpNorm<Eigen::Infinity>();
  const MatrixX first = derivatives.First(x), second = derivatives.Second(x, weights);
  const auto functions = [&](const VectorX& at) { return derivatives.Functions(at); };
  const auto gradient = [&](const VectorX& at) -> VectorX { return derivatives.First(at).transpose() * weights; };
  const double first_size = first.cwiseAbs().maxCoeff();
  EXPECT_LE((Differences(functions, x) - first).cwiseAbs().maxCoeff(), 1e-7 * std::max({1.0, size, first_size}));
  EXPECT_LE((Differences(gradient, x) - second).cwiseAbs().maxCoeff(),
            1e-7 * std::max({1.0, first_size, second.cwiseAbs().maxCoeff()}));
  EXPECT_GT(first_size, 0);
}

// Every index once, 0, 1, 2 …, up to the number of iterations.
void ExpectNumberedThrough(const std::vector<int>& indices, const NlpResult& result) {
  EXPECT_EQ(static_cast<int>(indices.size()), result.iterations + 1);
  for (size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(indices[i], static_cast<int>(i));
}

TEST_P(NlpSuite, EndsAsExpectedWhereItIsKnown) {
  const auto program = GetParam().make();
  bool restores = false;
  std::vector<int> indices;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) {
    restores = restores || info.restoration;
    indices.push_back(info.index);
  };
  const NlpResult ours = SolveNlp(*program, StartOf(GetParam()), SuiteOptions(), control);
  EXPECT_EQ(ours.termination, answer().ours) << ours.message;
  EXPECT_EQ(ours.restored_from >= 0, answer().is_taken_over);
  if (answer().restores != Restores::kByRounding) {
    EXPECT_EQ(restores, answer().restores == Restores::kYes);
  }
  ExpectNumberedThrough(indices, ours);
  const double value = ValueOf(*program, ours);
  indices.clear();
  const NlpResult ipopt = SolveWithIpopt(*program, StartOf(GetParam()), SuiteOptions(), control);
  ExpectNumberedThrough(indices, ipopt);
  EXPECT_EQ(ipopt.termination, answer().ipopt) << ipopt.message;
  const double ipopt_value = ValueOf(*program, ipopt);
  if (answer().values.empty()) {
    EXPECT_LE(DistanceBetween(value, ipopt_value), answer().tolerance) << value << ", Ipopt: " << ipopt_value;
    return;
  }
  if (answer().ours != Termination::kNumericalDifficulty) {
    EXPECT_LE(DistanceTo(answer().values, value), answer().tolerance) << value;
  }
  if (answer().ipopt != Termination::kNumericalDifficulty) {
    EXPECT_LE(DistanceTo(answer().values, ipopt_value), answer().tolerance) << ipopt_value;
  }
}

// What is unusual has its reason in the row.
TEST_P(NlpSuite, SaysWhyWhatIsUnusualIs) {
  const bool is_unusual = answer().values.size() > 1 || answer().tolerance > 1e-6 || answer().ours != answer().ipopt ||
                          answer().ours == Termination::kAcceptable || answer().restores == Restores::kByRounding;
  EXPECT_FALSE(is_unusual && answer().why.empty());
}

std::string NameOf(const ::testing::TestParamInfo<SuiteRow>& info) {
  std::string name;
  for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rows, NlpSuite, ::testing::ValuesIn(SuiteRows()), NameOf);

}  // namespace

}  // namespace rollgait::suite
