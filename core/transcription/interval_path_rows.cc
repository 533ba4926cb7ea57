#include "core/transcription/interval_path_rows.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/bernstein.h"
#include "core/ocp/constraints/friction.h"

namespace rollgait {
namespace {

constexpr double kVelocityShare = 0.1;  // of a limit, that scales rows of velocity

bool Contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

std::string KeyOf(const std::string& kind, int a, int coefficient, bool positive = true) {
  return kind + " " + std::to_string(a) + " " + std::to_string(coefficient) + (positive ? "" : " -");
}

// Rows: Bernstein coefficients of v (degree s) or q (degree s + 1) with h = 1 in terms of the scheme's sources.
MatrixX StateCoefficients(const EliminatedScheme& scheme, bool velocity) {
  const int s = scheme.points(), degree = velocity ? s : s + 1;
  MatrixX points(s, scheme.sources());  // accelerations at the points
  for (int i = 0; i < s; ++i) {
    for (int source = 0; source < scheme.sources(); ++source) {
      points(i, source) = scheme.Value(EliminatedScheme::kAcceleration, i, source, 1);
    }
  }
  // Monomials of the acceleration from those of its Bernstein form.
  const MatrixX monomials = BernsteinFromMonomials(s - 1).inverse() * BernsteinFromValues(scheme.tableau().c) * points;
  MatrixX state = MatrixX::Zero(degree + 1, scheme.sources());
  for (int j = 0; j < s; ++j) {
    if (velocity) {
      state.row(j + 1) += monomials.row(j) / (j + 1);
    } else {
      state.row(j + 2) += monomials.row(j) / ((j + 1) * (j + 2));
    }
  }
  state(0, velocity ? 1 : 0) += 1;
  if (!velocity) state(1, 1) += 1;
  return BernsteinFromMonomials(degree) * state;
}

}  // namespace

bool IntervalPathRows::Row::depends_on_step() const {
  return std::any_of(terms.begin(), terms.end(), [](const Term& term) { return term.power != 0; });
}

IntervalPathRows::IntervalPathRows(const OptimalControlProblem& problem, const AddedConstraints& added, int phase,
                                   const EliminatedScheme& scheme, const Locals& locals, const VectorX& scale)
    : from_points_(BernsteinFromValues(scheme.tableau().c)), scale_(scale) {
  AddForces(problem, phase, locals);
  if (phase >= static_cast<int>(added.between.size())) return;
  const BoundedBetween& between = added.between[phase];
  const std::vector<int>& actuated = problem.model.actuated();
  for (int joint : between.effort) {
    const auto place = std::find(actuated.begin(), actuated.end(), joint);
    if (place != actuated.end()) AddEfforts(problem, joint, static_cast<int>(place - actuated.begin()), locals);
  }
  for (int joint : between.velocity) AddStates(problem, joint, true, scheme, locals);
  for (int joint : between.range) AddStates(problem, joint, false, scheme, locals);
}

void IntervalPathRows::AddForces(const OptimalControlProblem& problem, int phase, const Locals& locals) {
  const int s = static_cast<int>(from_points_.rows()), efforts = static_cast<int>(problem.model.actuated().size());
  const std::vector<ActiveContact> active = problem.ActiveContacts(phase);
  const bool zero_at_start = problem.ForcesVanishAtStart(phase), zero_at_end = problem.ForcesVanishAtEnd(phase);
  const std::vector<int> taken = problem.TakenUp(phase), given = problem.GivenUp(phase);
  const double size = problem.force_size();
  // Coefficient k of the combination of forces.
  const auto terms = [&](int k, const std::vector<std::pair<int, double>>& forces) {
    std::vector<Term> sum;
    for (const auto& [offset, coefficient] : forces) {
      for (int i = 0; i < s; ++i) {
        if (from_points_(k, i) == 0) continue;
        sum.push_back({locals.controls[i] + efforts + offset, coefficient * from_points_(k, i) / size, 0});
      }
    }
    return sum;
  };
  for (int k = 0; k < s; ++k) {
    const bool is_point = from_points_.row(k).cwiseAbs().sum() == 1;
    for (const ActiveContact& contact : active) {
      if (is_point) continue;  // an unknown: it has a bound
      const int normal = contact.offset + static_cast<int>(contact.directions.size()) - 1;
      Row row{KeyOf("normal force", contact.contact, k),
              "normal force " + problem.contacts[contact.contact].name,
              "N",
              size,
              problem.min_normal_force / size,
              kInfinity,
              terms(k, {{normal, 1}})};
      if (k == 0 && zero_at_start && Contains(taken, contact.contact)) row.at_start = AtZero::kEquals;
      rows_.push_back(std::move(row));
    }
    // Of the two rows of a direction one becomes the equation. At a point the shares of a link's force along x are
    // equations already.
    const auto at_zero = [is_point](const ForceRow& row) {
      return row.positive && !(row.shared && is_point) ? AtZero::kEquals : AtZero::kFree;
    };
    int number = 0;
    for (const ForceRow& friction : FrictionRows(problem.contacts, active, problem.friction_coefficient)) {
      Row row{KeyOf("friction", number++, k), friction.name, "N", size, 0, kInfinity, terms(k, friction.terms)};
      if (k == 0 && zero_at_start && Contains(taken, friction.contact)) row.at_start = at_zero(friction);
      if (k == s - 1 && zero_at_end && Contains(given, friction.contact)) row.at_end = at_zero(friction);
      rows_.push_back(std::move(row));
    }
  }
}

void IntervalPathRows::AddEfforts(const OptimalControlProblem& problem, int joint, int effort, const Locals& locals) {
  const Joint& limits = problem.model.joint(joint);
  for (int k = 0; k < from_points_.rows(); ++k) {
    if (from_points_.row(k).cwiseAbs().sum() == 1) continue;
    const double size = problem.effort_size();
    Row row{KeyOf("effort", joint, k),
            "effort " + limits.name,
            limits.type == JointType::kPrismatic ? "N" : "N m",
            size,
            limits.effort_min / size,
            limits.effort_max / size,
            {}};
    for (int i = 0; i < from_points_.cols(); ++i) {
      if (from_points_(k, i) != 0) row.terms.push_back({locals.controls[i] + effort, from_points_(k, i) / size, 0});
    }
    rows_.push_back(std::move(row));
  }
}

void IntervalPathRows::AddStates(const OptimalControlProblem& problem, int joint, bool velocity,
                                 const EliminatedScheme& scheme, const Locals& locals) {
  const Joint& limits = problem.model.joint(joint);
  const MatrixX coefficients = StateCoefficients(scheme, velocity);
  const bool prismatic = limits.type == JointType::kPrismatic;
  // The first and the last coefficient are states of nodes, which have bounds.
  for (int k = 1; k + 1 < coefficients.rows(); ++k) {
    const double size = velocity ? kVelocityShare * limits.velocity_max : 1;
    Row row{KeyOf(velocity ? "velocity" : "range", joint, k),
            (velocity ? "velocity " : "range ") + limits.name,
            std::string(prismatic ? "m" : "rad") + (velocity ? "/s" : ""),
            size,
            (velocity ? -limits.velocity_max : limits.position_min) / size,
            (velocity ? limits.velocity_max : limits.position_max) / size,
            {}};
    for (int source = 0; source < scheme.sources(); ++source) {
      if (std::abs(coefficients(k, source)) < 1e-12) continue;  // rounding of the inverse
      const int order = source >= 4 ? 2 : source % 2;           // of the derivative that the source is
      row.terms.push_back({locals.sources[source] + joint, coefficients(k, source) / size, order - (velocity ? 1 : 0)});
    }
    rows_.push_back(std::move(row));
  }
}

void IntervalPathRows::Bounds(const IntervalPlace& place, double* lower, double* upper) const {
  for (const Row& row : rows_) {
    const bool starts = place.first && row.at_start != AtZero::kSame, ends = place.last && row.at_end != AtZero::kSame;
    const AtZero zero = starts ? row.at_start : ends ? row.at_end : AtZero::kSame;
    *lower++ = zero == AtZero::kFree ? -kInfinity : row.lower;
    *upper++ = zero == AtZero::kEquals ? row.lower : row.upper;
  }
}

Entries IntervalPathRows::JacobianPattern(int step) const {
  Entries entries;
  for (int r = 0; r < size(); ++r) {
    for (const Term& term : rows_[r].terms) entries.emplace_back(r, term.local);
    if (rows_[r].depends_on_step()) entries.emplace_back(r, step);
  }
  return entries;
}

Entries IntervalPathRows::HessianPairs(int step) const {
  std::set<std::pair<int, int>> pairs;
  for (const Row& row : rows_) {
    for (const Term& term : row.terms) {
      if (term.power != 0) pairs.emplace(term.local, step);
    }
    if (row.depends_on_step()) pairs.emplace(step, step);
  }
  return {pairs.begin(), pairs.end()};
}

void IntervalPathRows::Values(const double* y, double h, double* g) const {
  for (const Row& row : rows_) {
    double sum = 0;
    for (const Term& term : row.terms)
      sum += term.coefficient * std::pow(h, term.power) * scale_(term.local) * y[term.local];
    *g++ = sum;
  }
}

double* IntervalPathRows::Jacobian(const double* y, double h, double* values) const {
  for (const Row& row : rows_) {
    double by_step = 0;
    for (const Term& term : row.terms) {
      const double factor = term.coefficient * scale_(term.local);
      *values++ = factor * std::pow(h, term.power);
      by_step += factor * term.power * std::pow(h, term.power - 1) * y[term.local];
    }
    if (row.depends_on_step()) *values++ = by_step;
  }
  return values;
}

void IntervalPathRows::AddHessian(const double* y, double h, const double* lambda, Eigen::Ref<MatrixX> local) const {
  const Eigen::Index step = local.rows() - 1;
  for (const Row& row : rows_) {
    const double multiplier = *lambda++;
    for (const Term& term : row.terms) {
      if (term.power == 0) continue;
      const double factor = multiplier * term.coefficient * term.power;
      local(step, term.local) += factor * std::pow(h, term.power - 1);
      local(step, step) += factor * (term.power - 1) * std::pow(h, term.power - 2) * scale_(term.local) * y[term.local];
    }
  }
}

}  // namespace rollgait
