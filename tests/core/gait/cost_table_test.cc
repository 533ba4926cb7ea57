// Every row of the table of costs, whatever it is: what holds for all of them.
#include "core/ocp/cost_table.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/core/transcription/planar_request.h"

namespace rollgait {
namespace {

constexpr size_t kKinds = std::tuple_size_v<decltype(kCostTable)>;

TEST(CostTable, NamesAndFieldsAreUnique) {
  std::set<std::string> fields, names;
  ForEachCost([&](const auto& row) {
    fields.insert(row.traits.field);
    names.insert(row.traits.name);
  });
  EXPECT_EQ(fields.size(), kKinds);
  EXPECT_EQ(names.size(), kKinds);
}

TEST(CostTable, ATermThatIsNotSetIsTheSquaredTorque) { EXPECT_STREQ(TraitsOf(cost::Term()).field, "squared_torque"); }

// Powers of mass and time in a unit such as "N² m²/s": what follows a slash divides.
std::pair<int, int> Dimension(const std::string& unit) {
  const std::map<char, std::pair<int, int>> symbols = {{'N', {1, -2}}, {'J', {1, -2}}, {'s', {0, 1}}, {'m', {0, 0}}};
  const std::map<std::string, int> exponents = {{"²", 2}, {"³", 3}};
  std::pair<int, int> powers{0, 0};
  int sign = 1;
  for (size_t i = 0; i < unit.size(); ++i) {
    if (unit[i] == '/') sign = -1;
    if (unit.compare(i, 3, "rad") == 0) i += 2;
    const auto symbol = symbols.find(unit[i]);
    if (symbol == symbols.end()) continue;
    const auto exponent = exponents.find(unit.substr(i + 1, 2));
    const int times = sign * (exponent == exponents.end() ? 1 : exponent->second);
    powers.first += times * symbol->second.first;
    powers.second += times * symbol->second.second;
  }
  return powers;
}

TEST(CostTable, UnitsHaveTheDimensionOfTheIntegral) {
  EXPECT_EQ(Dimension("N² m²/s³"), std::pair(2, -7));
  ForEachCost([](const auto& row) {
    const CostTraits& traits = row.traits;
    EXPECT_EQ(Dimension(traits.unit), std::pair(traits.mass_power, traits.time_power + 1)) << traits.field;
  });
}

// The field that CheckRequest names, "" if it refuses nothing.
std::string Refused(cost::Term term) {
  GaitRequest request;
  request.body.model = "planar";
  request.costs = {{std::move(term), 1.0}};
  const Result<GaitSpec> checked = CheckRequest(request);
  return checked.ok() ? "" : checked.violations()[0].field;
}

TEST(CostTable, ParametersHaveTheirDefaultsAndRanges) {
  int count = 0;
  ForEachCost([&count]<typename Term>(const CostRow<Term>& row) {
    row.ForEachParameter([&](const CostParameter<Term>& parameter) {
      const std::string field = "costs[0]." + std::string(row.traits.field) + "." + parameter.field;
      EXPECT_GE(parameter.fallback, parameter.min) << field;
      EXPECT_LE(parameter.fallback, parameter.max) << field;
      Term term;
      for (const auto& [value, refused] : {std::pair(parameter.min, ""), {parameter.max, ""}}) {
        term.*parameter.member = value;
        EXPECT_EQ(Refused(term), refused) << field << " " << value;
      }
      for (const double value : {0.999 * parameter.min, 1.001 * parameter.max, std::nan("")}) {
        term.*parameter.member = value;
        EXPECT_EQ(Refused(term), field) << value;
      }
      GaitRequest request;
      request.body.model = "planar";
      request.body.mass = 75;
      request.costs = {{Term(), 1.0}};
      const GaitSpec spec = CheckRequest(request).value();
      EXPECT_NEAR((std::get<Term>(spec.costs[0].term).*parameter.member).value(), parameter.fallback,
                  1e-12 * parameter.fallback)
          << field;
      ++count;
    });
    if constexpr (HasJointWeights<Term>) {
      Term term;
      term.joint_weights["hip_l"] = -1;
      EXPECT_EQ(Refused(term), "costs[0]." + std::string(row.traits.field) + ".joint_weights[\"hip_l\"]");
      ++count;
    }
  });
  EXPECT_GE(count, 11);
}

class EveryCost : public ::testing::TestWithParam<size_t> {
 protected:
  // A planar walk with this cost alone, somewhere near the built-in guess.
  EveryCost() {
    GaitRequest request = PlanarRequestWithEveryTerm();
    std::erase_if(request.costs,
                  [](const GaitRequest::CostTerm& cost) { return cost.term.index() != EveryCost::GetParam(); });
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    nlp_ = std::make_unique<CollocationNlp>(*problem_, Scheme::kRadau2, Mesh::Uniform({1, 2}));
    x_ = nlp_->MakeStart(WalkingGuess(*spec_, *problem_));
    for (int i = 0; i < x_.size(); ++i) x_(i) += 0.05 * std::sin(5.0 * i);
  }
  VectorX GradientAt(const VectorX& x) {
    VectorX gradient(x.size());
    EXPECT_TRUE(nlp_->Gradient(x.data(), gradient.data()));
    return gradient;
  }
  // The Hessian of the objective alone, both triangles.
  MatrixX Hessian() {
    const VectorX lambda = VectorX::Zero(nlp_->constraints());
    VectorX values(nlp_->hessian_pattern().size());
    EXPECT_TRUE(nlp_->Hessian(x_.data(), 1, lambda.data(), values.data()));
    MatrixX hessian = MatrixX::Zero(x_.size(), x_.size());
    for (int e = 0; e < values.size(); ++e) {
      const int r = nlp_->hessian_pattern().rows[e], c = nlp_->hessian_pattern().columns[e];
      hessian(r, c) += values(e);
      if (r != c) hessian(c, r) += values(e);
    }
    return hessian;
  }

  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_;
};

TEST_P(EveryCost, IsDescribedByItsRow) {
  ASSERT_EQ(problem_->costs.size(), 1u);
  const CostTraits& traits = TraitsOf(spec_->costs[0].term);
  EXPECT_EQ(problem_->costs[0].name, traits.name);
  EXPECT_EQ(problem_->costs[0].unit, traits.unit);
  // Typical sizes scale the objective: a guess is within a factor of 1000.
  const VectorX integral = nlp_->CostIntegrals(x_.data());
  EXPECT_GT(integral(0), 0);
  EXPECT_GT(integral(0), 1e-3 * problem_->costs[0].Typical()) << traits.name;
  EXPECT_LT(integral(0), 1e3 * problem_->costs[0].Typical()) << traits.name;
}

// Central differences with step 1e-6, relative to the largest entry.
TEST_P(EveryCost, DerivativesMeetDifferences) {
  constexpr double kStep = 1e-6;
  const VectorX gradient = GradientAt(x_);
  const MatrixX hessian = Hessian();
  const double slope = gradient.cwiseAbs().maxCoeff(), curvature = hessian.cwiseAbs().maxCoeff();
  EXPECT_GT(slope, 0);
  EXPECT_GT(curvature, 0);
  for (int j = 0; j < x_.size(); ++j) {
    VectorX up = x_, down = x_;
    up(j) += kStep;
    down(j) -= kStep;
    double f_up, f_down;
    ASSERT_TRUE(nlp_->Objective(up.data(), &f_up));
    ASSERT_TRUE(nlp_->Objective(down.data(), &f_down));
    EXPECT_NEAR((f_up - f_down) / (2 * kStep), gradient(j), 1e-7 * slope) << j;
    const VectorX column = (GradientAt(up) - GradientAt(down)) / (2 * kStep);
    EXPECT_LT((column - hessian.col(j)).cwiseAbs().maxCoeff(), 1e-7 * curvature) << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryCost, ::testing::Range<size_t>(0, kKinds), [](const auto& test) {
  std::string name;
  ForEachCost([&, kind = size_t{0}](const auto& row) mutable {
    if (kind++ == test.param) name = row.traits.field;
  });
  return name;
});

}  // namespace
}  // namespace rollgait
