// Friction between the points: the sides of pyramids at the Bernstein coefficients of the forces, what becomes of them
// where forces vanish, and what flat sides cost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/math/bernstein.h"
#include "tests/core/transcription/path_rows_fixture.h"

namespace rollgait {
namespace {

class FrictionRowsTest : public PathRowsFixture {};

// Their values are those of the sides at the Bernstein coefficients of the forces, 45° wide but for those that the
// added edge at 60° makes.
TEST_P(FrictionRowsTest, FrictionHoldsAtEveryBernsteinCoefficientOfTheForces) {
  Build(Preset::kHuman);
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<std::pair<double, double>> sides;  // degrees
  for (const double edge : {0, 45, 90, 135, 180, 225, 270, 315}) sides.emplace_back(edge, edge + 45);
  sides[1] = {45, 60};
  sides.insert(sides.begin() + 2, {60, 90});
  const double mu = problem_->friction_coefficient;
  const int s = trajectory_.points_per_interval;
  const MatrixX to_coefficients = BernsteinFromValues(Eigen::Map<const VectorX>(
      trajectory_.point_fractions.data(), static_cast<int>(trajectory_.point_fractions.size())));
  for (int phase = 0; phase < static_cast<int>(trajectory_.phases.size()); ++phase) {
    const TrajectoryPhase& data = trajectory_.phases[phase];
    for (int interval = 0; interval < kIntervals; ++interval) {
      for (int c = 0; c < static_cast<int>(data.contacts.size()); ++c) {
        const int offset = problem_->ActiveContacts(phase)[c].offset, size = InSpace() ? 3 : 2;
        MatrixX points(s, 3);  // forces as they are in the NLP, where surfaces of a link have not shared them yet
        points.setZero();
        for (int i = 0; i < s; ++i) {
          const int unknown = nlp_->layout().forces(nlp_->layout().first_interval(phase) + interval, i) + offset;
          points(i, 0) = x_(unknown);
          if (InSpace()) points(i, 1) = x_(unknown + 1);
          points(i, 2) = x_(unknown + size - 1);
        }
        const MatrixX coefficients = problem_->force_size() * to_coefficients * points;
        std::vector<double> expected;
        for (int k = 0; k < s; ++k) {
          const Vector3 force = coefficients.row(k).transpose();
          if (!InSpace()) {
            expected.insert(expected.end(), {mu * force.z() + force.x(), mu * force.z() - force.x()});
            continue;
          }
          for (const auto& [from, to] : sides) {
            const double middle = (from + to) / 2 * kDegree, half = (to - from) / 2 * kDegree;
            expected.push_back(mu * std::cos(half) * force.z() - std::cos(middle) * force.x() -
                               std::sin(middle) * force.y());
          }
        }
        const std::vector<double> values =
            Named("friction " + problem_->contacts[data.contacts[c]].name, phase, interval).values;
        ASSERT_EQ(values.size(), expected.size());
        for (size_t r = 0; r < values.size(); ++r) EXPECT_NEAR(values[r], expected[r], 1e-10 * problem_->force_size());
      }
    }
  }
}

// Where the forces of a contact vanish, as many rows of its friction become equations as there are tangential forces
// that no other row holds, and the other rows hold nothing.
TEST_P(FrictionRowsTest, AsManyFrictionRowsAreEquationsAsTangentialForcesVanish) {
  Build(Preset::kHuman);
  const int tangential = InSpace() ? 2 : 1, sides = InSpace() ? 9 : 2;
  int checked = 0;
  for (int phase = 0; phase < static_cast<int>(trajectory_.phases.size()); ++phase) {
    const std::vector<int> gives = problem_->GivenUp(phase), takes = problem_->TakenUp(phase);
    const std::vector<int>& active = problem_->phases[phase].active;
    for (const bool at_start : {true, false}) {
      for (int contact : at_start ? takes : gives) {
        const Rows rows = Named("friction " + problem_->contacts[contact].name, phase, at_start ? 0 : kIntervals - 1);
        ASSERT_EQ(static_cast<int>(rows.values.size()), sides * trajectory_.points_per_interval);
        const bool shares = std::count_if(active.begin(), active.end(), [&](int other) {
                              return problem_->contacts[other].joint == problem_->contacts[contact].joint;
                            }) > 1;
        const bool is_point = !at_start || Lobatto();
        const int expected = tangential - (shares && is_point ? 1 : 0);
        int equations = 0, bounds = 0;
        const int first = at_start ? 0 : static_cast<int>(rows.values.size()) - sides;
        for (int r = first; r < first + sides; ++r) {
          equations += rows.lower[r] == 0 && rows.upper[r] == 0 ? 1 : 0;
          bounds += rows.lower[r] == 0 && rows.upper[r] == kInfinity ? 1 : 0;
        }
        EXPECT_EQ(equations, expected) << problem_->contacts[contact].name << (at_start ? " taken up" : " given up");
        EXPECT_EQ(bounds, 0);
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 4);  // heel and forefoot, taken up and given up
}

// A force on the side from 0 to 45° of one contact, 10° from x, and one multiplier there: with the cone in place of the
// side the tangential force could grow by μ f_n (1 − cos 22.5°) along the side's normal. The force would meet the cone
// between its own direction and the normal.
TEST_P(FrictionRowsTest, FlatSidesCostWhatTheirMultipliersSay) {
  Build(Preset::kHuman);
  VectorX multipliers = VectorX::Zero(nlp_->constraints());
  if (!InSpace()) {
    multipliers.setConstant(-1);
    EXPECT_TRUE(nlp_->FlatSides(x_.data(), multipliers).empty());
    return;
  }
  constexpr double kDegree = std::numbers::pi / 180;
  const double mu = problem_->friction_coefficient, size = problem_->force_size(), normal = 0.7 * size;
  const int phase = 1, interval = 1;
  const ActiveContact contact = problem_->ActiveContacts(phase).back();
  const double tangential = mu * normal * std::cos(22.5 * kDegree) / std::cos(12.5 * kDegree);
  for (int i = 0; i < trajectory_.points_per_interval; ++i) {
    const int unknown = nlp_->layout().forces(nlp_->layout().first_interval(phase) + interval, i) + contact.offset;
    x_.segment<3>(unknown) =
        Vector3(tangential * std::cos(10 * kDegree), tangential * std::sin(10 * kDegree), normal) / size;
  }
  ASSERT_TRUE(nlp_->Constraints(x_.data(), g_.data()));
  EXPECT_TRUE(nlp_->FlatSides(x_.data(), multipliers).empty());
  const std::string name = "friction " + problem_->contacts[contact.contact].name;
  const double begin = trajectory_.phases[phase].node_times[interval] + 1e-12;
  for (int r = 0; r < nlp_->constraints(); ++r) {
    const RowInfo info = nlp_->Describe(x_.data(), r);
    if (info.phase != phase || info.name != name || info.time < begin) continue;
    EXPECT_NEAR(g_(r), 0, 1e-12);
    multipliers(r) = -3;
    break;  // the side from 0 to 45° at the first coefficient
  }
  std::vector<FlatSide> sides = nlp_->FlatSides(x_.data(), multipliers);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_EQ(sides[0].phase, phase);
  EXPECT_EQ(sides[0].contact, contact.contact);
  EXPECT_EQ(sides[0].side.from, 0);
  EXPECT_EQ(sides[0].side.to, 9);
  const double cost = 3 * mu * normal / size * (1 - std::cos(22.5 * kDegree)) / nlp_->objective_scale();
  EXPECT_NEAR(sides[0].cost, cost, 1e-12 * cost);
  EXPECT_NEAR(sides[0].direction, 16.25 * kDegree, 1e-12);
  // A multiplier of the other sign holds the force from nothing.
  multipliers *= -1;
  EXPECT_TRUE(nlp_->FlatSides(x_.data(), multipliers).empty());
}

// What these figures are of: the least of a linear function over the cone and over the pyramid differ by that cost.
// With the gradient −(cos γ, sin γ) the pyramid's force is at the edge next to γ, and its sides' multipliers add up to
// the gradient.
TEST_P(FrictionRowsTest, AnEdgeCostsWhatTheConeWouldGain) {
  Build(Preset::kHuman);
  if (!InSpace()) {
    EXPECT_EQ(FrictionRows(problem_->contacts, problem_->ActiveContacts(0), 1, added_.between[0].friction).size(),
              2 * problem_->ActiveContacts(0).size());
    return;
  }
  constexpr double kDegree = std::numbers::pi / 180;
  const double mu = problem_->friction_coefficient, size = problem_->force_size(), normal = 0.3 * size;
  const int phase = 0, interval = nlp_->layout().first_interval(0);
  const ActiveContact contact = problem_->ActiveContacts(phase).back();
  for (int i = 0; i < trajectory_.points_per_interval; ++i) {
    x_.segment<3>(nlp_->layout().forces(interval, i) + contact.offset) = Vector3(mu * normal, 0, normal) / size;
  }
  // At the edge x the sides with the normals at ±22.5°; by N of the force.
  const double gamma = 14 * kDegree;
  const double sum = std::cos(gamma) / std::cos(22.5 * kDegree),
               difference = std::sin(gamma) / std::sin(22.5 * kDegree);
  VectorX multipliers = VectorX::Zero(nlp_->constraints());
  const std::string name = "friction " + problem_->contacts[contact.contact].name;
  int found = 0;
  for (int r = 0; r < nlp_->constraints() && found < 9; ++r) {
    const RowInfo info = nlp_->Describe(x_.data(), r);
    if (info.phase != phase || info.name != name || info.time > trajectory_.phases[phase].node_times[1] + 1e-12)
      continue;
    if (found == 0) multipliers(r) = -(sum + difference) / 2 * size;
    if (found == 8) multipliers(r) = -(sum - difference) / 2 * size;
    ++found;
  }
  ASSERT_EQ(found, 9);
  const std::vector<FlatSide> sides = nlp_->FlatSides(x_.data(), multipliers);
  ASSERT_EQ(sides.size(), 1u);
  const double gain = mu * normal * (1 - std::cos(gamma)) / nlp_->objective_scale();
  EXPECT_NEAR(sides[0].cost, gain, 1e-10 * gain);
  EXPECT_EQ(sides[0].side.from, 0);
  EXPECT_NEAR(sides[0].direction, gamma / 2, 1e-10);
}

// A side has the same multiplier whatever other edges the pyramid has; those that an edge makes new have none yet.
TEST_P(FrictionRowsTest, MultipliersOfSidesSurviveTheSplittingOfOthers) {
  Build(Preset::kHuman);
  if (!InSpace()) {
    EXPECT_EQ(Named("friction " + problem_->contacts[trajectory_.phases[1].contacts[0]].name, 1, 0).values.size(),
              2u * static_cast<size_t>(trajectory_.points_per_interval));
    return;
  }
  const CollocationNlp plain(*problem_, GetParam().scheme, nlp_->mesh());
  NlpResult solved;
  solved.constraint_multipliers = VectorX::LinSpaced(plain.constraints(), 1, 2);
  solved.lower_bound_multipliers = solved.upper_bound_multipliers = VectorX::Zero(plain.variables());
  NlpStart start;
  nlp_->TransferMultipliers(plain, solved, &start);
  // Of an interval in the middle of a phase, in which no row is an equation.
  const auto sides = [&](const CollocationNlp& nlp, const VectorX& multipliers) {
    std::vector<double> values;
    const std::string name = "friction " + problem_->contacts[trajectory_.phases[1].contacts[0]].name;
    for (int r = 0; r < nlp.constraints(); ++r) {
      const RowInfo info = nlp.Describe(x_.data(), r);
      if (info.phase == 1 && info.name == name) values.push_back(multipliers(r));
    }
    return values;
  };
  std::vector<double> before = sides(plain, solved.constraint_multipliers),
                      after = sides(*nlp_, start.constraint_multipliers);
  ASSERT_EQ(before.size() / 8, after.size() / 9);
  for (size_t pyramid = 0; pyramid < before.size() / 8; ++pyramid) {
    for (size_t side = 0; side < 9; ++side) {
      const double value = after[9 * pyramid + side];
      if (side == 1 || side == 2) {
        EXPECT_EQ(value, 0) << side;
      } else {
        EXPECT_NEAR(value, before[8 * pyramid + (side > 2 ? side - 1 : side)], 1e-9) << side;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, FrictionRowsTest,
    ::testing::Values(PathRowsCase{"planar", Scheme::kRadau2}, PathRowsCase{"planar", Scheme::kRadau3},
                      PathRowsCase{"planar", Scheme::kHermiteSimpson}, PathRowsCase{"planar", Scheme::kRadau4},
                      PathRowsCase{"planar", Scheme::kLobatto5}, PathRowsCase{"human29", Scheme::kRadau2}));

}  // namespace
}  // namespace rollgait
