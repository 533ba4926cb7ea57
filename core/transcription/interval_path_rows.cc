#include "core/transcription/interval_path_rows.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/check.h"
#include "core/math/bernstein.h"

namespace rollgait {
namespace {

constexpr double kVelocityShare = 0.1;  // of a limit, that scales rows of velocity

bool Contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

std::string KeyOf(const std::string& kind, int a, int coefficient) {
  return kind + " " + std::to_string(a) + " " + std::to_string(coefficient);
}

// A side keeps its name when other sides are split.
std::string KeyOf(const ForceRow& friction, int coefficient) {
  return KeyOf("friction", friction.contact, coefficient) + " " + std::to_string(friction.side.from) + " " +
         std::to_string(friction.side.to);
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
  AddForces(problem, phase, added.Edges(phase), locals);
  AddDegree(problem,
            std::min(problem.phases[phase].effort_degree.value_or(scheme.points()), scheme.tableau().effort_degree),
            scheme.tableau().c, locals);
  if (phase >= static_cast<int>(added.between.size())) return;
  const BoundedBetween& between = added.between[phase];
  const std::vector<int>& actuated = problem.model.actuated();
  for (int joint : between.effort) {
    const auto place = std::find(actuated.begin(), actuated.end(), joint);
    if (place != actuated.end()) AddEfforts(problem, phase, static_cast<int>(place - actuated.begin()), locals);
  }
  for (int joint : between.velocity) AddStates(problem, joint, true, scheme, locals);
  for (int joint : between.range) AddStates(problem, joint, false, scheme, locals);
}

std::vector<IntervalPathRows::Term> IntervalPathRows::ForceTerms(int k, const std::vector<int>& forces, double unit,
                                                                 const ForceSum& sum) const {
  std::vector<Term> terms;
  for (const auto& [offset, coefficient] : sum) {
    for (int i = 0; i < from_points_.cols(); ++i) {
      if (from_points_(k, i) == 0) continue;
      terms.push_back({forces[i] + offset, coefficient * from_points_(k, i) / unit, 0});
    }
  }
  return terms;
}

void IntervalPathRows::AddForces(const OptimalControlProblem& problem, int phase,
                                 const std::vector<FrictionEdge>& edges, const Locals& locals) {
  const int s = static_cast<int>(from_points_.rows()), efforts = static_cast<int>(problem.model.actuated().size());
  const std::vector<ActiveContact> active = problem.ActiveContacts(phase);
  const std::vector<ForceRow> friction = FrictionRows(problem.contacts, active, problem.friction_coefficient, edges);
  const bool zero_at_start = problem.ForcesVanishAtStart(phase), zero_at_end = problem.ForcesVanishAtEnd(phase);
  const std::vector<int> taken = problem.TakenUp(phase), given = problem.GivenUp(phase);
  const double size = problem.force_size();
  std::vector<int> forces = locals.controls;
  for (int& first : forces) first += efforts;
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
              ForceTerms(k, forces, size, {{normal, 1}})};
      if (k == 0 && zero_at_start && Contains(taken, contact.contact)) row.at_start = AtZero::kEquals;
      rows_.push_back(std::move(row));
    }
    // The independent rows become equations. At a point the shares of a link's force along x are equations already.
    const auto at_zero = [is_point](const ForceRow& row) {
      return row.independent && !(row.shared && is_point) ? AtZero::kEquals : AtZero::kFree;
    };
    for (const ForceRow& side : friction) {
      Row row{KeyOf(side, k), side.name, "N", size, 0, kInfinity, ForceTerms(k, forces, size, side.terms)};
      if (k == 0 && zero_at_start && Contains(taken, side.contact)) row.at_start = at_zero(side);
      if (k == s - 1 && zero_at_end && Contains(given, side.contact)) row.at_end = at_zero(side);
      rows_.push_back(std::move(row));
    }
    AddPyramids(k, forces, active, friction);
  }
}

// Of the rows of friction, which are the last ones.
void IntervalPathRows::AddPyramids(int k, const std::vector<int>& forces, const std::vector<ActiveContact>& active,
                                   const std::vector<ForceRow>& friction) {
  const int first = static_cast<int>(rows_.size() - friction.size());
  for (const ActiveContact& contact : active) {
    if (contact.directions.size() < 3) continue;
    Pyramid pyramid{contact.contact, {}, {}};
    for (int d = 0; d < 3; ++d) pyramid.forces[d] = ForceTerms(k, forces, 1, {{contact.offset + d, 1}});
    for (size_t r = 0; r < friction.size(); ++r) {
      if (friction[r].contact != contact.contact) continue;
      const double middle = friction[r].side.middle();
      pyramid.sides.emplace_back(first + static_cast<int>(r), Eigen::Vector2d(std::cos(middle), std::sin(middle)));
    }
    pyramids_.push_back(std::move(pyramid));
  }
}

std::vector<IntervalPathRows::HeldForce> IntervalPathRows::HeldForces(const double* y, const double* lambda) const {
  std::vector<HeldForce> held;
  for (const Pyramid& pyramid : pyramids_) {
    HeldForce force{pyramid.contact, Vector3::Zero(), Eigen::Vector2d::Zero()};
    for (int d = 0; d < 3; ++d) {
      for (const Term& term : pyramid.forces[d])
        force.force(d) += term.coefficient * scale_(term.local) * y[term.local];
    }
    // The multiplier of a lower bound is negative.
    for (const auto& [row, normal] : pyramid.sides) {
      force.pull += std::max(0.0, -lambda[row]) / rows_[row].size * normal;
    }
    held.push_back(force);
  }
  return held;
}

// Divided differences of a higher order than the degree, over the largest of their coefficients.
void IntervalPathRows::AddDegree(const OptimalControlProblem& problem, int degree, const VectorX& c,
                                 const Locals& locals) {
  ROLLGAIT_CHECK(degree >= 0);
  for (int order = degree + 1; order < static_cast<int>(c.size()); ++order) {
    VectorX difference = VectorX::Ones(order + 1);
    for (int i = 0; i <= order; ++i) {
      for (int j = 0; j <= order; ++j) {
        if (j != i) difference(i) /= c(i) - c(j);
      }
    }
    difference /= difference.cwiseAbs().maxCoeff();
    for (int effort = 0; effort < static_cast<int>(problem.model.actuated().size()); ++effort) {
      const int joint = problem.model.actuated()[static_cast<size_t>(effort)];
      const Joint& limits = problem.model.joint(joint);
      const double size = problem.effort_size();
      Row row{KeyOf("degree", joint, order),
              "degree of effort " + limits.name,
              limits.kind().effort_unit(),
              size,
              0,
              0,
              {}};
      for (int i = 0; i <= order; ++i) row.terms.push_back({locals.controls[i] + effort, difference(i) / size, 0});
      rows_.push_back(std::move(row));
    }
  }
}

void IntervalPathRows::AddEfforts(const OptimalControlProblem& problem, int phase, int effort, const Locals& locals) {
  const int joint = problem.model.actuated()[static_cast<size_t>(effort)];
  const Joint& limits = problem.model.joint(joint);
  const Interval bounds = problem.EffortBounds(phase, effort);
  for (int k = 0; k < from_points_.rows(); ++k) {
    if (from_points_.row(k).cwiseAbs().sum() == 1) continue;
    const double size = problem.effort_size();
    Row row{KeyOf("effort", joint, k),
            "effort " + limits.name,
            limits.kind().effort_unit(),
            size,
            bounds.min / size,
            bounds.max / size,
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
  // The first and the last coefficient are states of nodes, which have bounds.
  for (int k = 1; k + 1 < coefficients.rows(); ++k) {
    const double size = velocity ? kVelocityShare * limits.velocity_max : 1;
    Row row{KeyOf(velocity ? "velocity" : "range", joint, k),
            (velocity ? "velocity " : "range ") + limits.name,
            std::string(limits.kind().unit()) + (velocity ? "/s" : ""),
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
