#include "core/ocp/constraints/friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/check.h"

namespace rollgait {
namespace {

constexpr double kStep = 2 * std::numbers::pi / FrictionEdge::kDirections;
constexpr int kUsualEdges = 8;
constexpr int kAcross = FrictionEdge::kDirections / 4;  // the direction y
constexpr int kBack = FrictionEdge::kDirections / 2;    // the direction −x

std::vector<FrictionSide> SidesOf(int contact, bool in_space, const std::vector<FrictionEdge>& added) {
  if (!in_space) return {{kBack, kBack}, {0, 0}};
  const std::vector<int> edges = FrictionDirections(contact, added);
  std::vector<FrictionSide> sides;
  for (size_t e = 0; e < edges.size(); ++e) {
    sides.push_back({edges[e], e + 1 < edges.size() ? edges[e + 1] : FrictionEdge::kDirections});
  }
  return sides;
}

}  // namespace

double FrictionSide::middle() const { return kStep * (from + to) / 2; }
double FrictionSide::half_width() const { return kStep * (to - from) / 2; }

std::vector<int> FrictionDirections(int contact, const std::vector<FrictionEdge>& added) {
  std::set<int> directions;
  for (int e = 0; e < kUsualEdges; ++e) directions.insert(e * FrictionEdge::kDirections / kUsualEdges);
  for (const FrictionEdge& edge : added) {
    ROLLGAIT_CHECK(edge.direction >= 0 && edge.direction < FrictionEdge::kDirections);
    if (edge.contact == contact) directions.insert(edge.direction);
  }
  return {directions.begin(), directions.end()};
}

std::vector<ForceRow> FrictionRows(const std::vector<ContactSurface>& contacts,
                                   const std::vector<ActiveContact>& active, double coefficient,
                                   const std::vector<FrictionEdge>& added) {
  std::vector<ForceRow> rows;
  for (const ActiveContact& contact : active) {
    const ContactSurface& surface = contacts[contact.contact];
    const bool alone = std::none_of(active.begin(), active.end(), [&](const ActiveContact& other) {
      return other.contact != contact.contact && contacts[other.contact].joint == surface.joint;
    });
    if (contact.directions.size() < 2) continue;  // no friction
    const bool in_space = contact.directions.size() > 2;
    const int normal = contact.offset + static_cast<int>(contact.directions.size()) - 1;
    for (const FrictionSide& side : SidesOf(contact.contact, in_space, added)) {
      ForceRow row{"friction " + surface.name, {}, contact.contact, side, false, false};
      row.terms = {{normal, coefficient * std::cos(side.half_width())}, {contact.offset, -std::cos(side.middle())}};
      if (in_space) row.terms.emplace_back(contact.offset + 1, -std::sin(side.middle()));
      // A side is at most 45° wide, so that the middles of these two are 67.5 to 112.5° apart; the second one is within
      // 22.5° of y.
      const bool along = side.from == (in_space ? 0 : kBack);
      row.independent = along || (in_space && side.from == kAcross);
      row.shared = along && !alone && contact.directions[0] == 0;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

void FrictionConstraint::Bounds(double, double* lower, double* upper) const {
  std::fill_n(lower, rows(), 0.0);
  std::fill_n(upper, rows(), kInfinity);
}
Entries FrictionConstraint::JacobianPattern() const {
  Entries entries;
  for (int r = 0; r < rows(); ++r) {
    for (const auto& [offset, coefficient] : rows_[r].terms) entries.emplace_back(r, layout_.force() + offset);
  }
  return entries;
}
void FrictionConstraint::Value(const PointContext& at, double* g) {
  for (const ForceRow& row : rows_) {
    double sum = 0;
    for (const auto& [offset, coefficient] : row.terms) sum += coefficient * at.z[layout_.force() + offset];
    *g++ = sum;
  }
}
void FrictionConstraint::Jacobian(const PointContext&, Eigen::Ref<MatrixX> jacobian) {
  for (int r = 0; r < rows(); ++r) {
    for (const auto& [offset, coefficient] : rows_[r].terms) jacobian(r, layout_.force() + offset) = coefficient;
  }
}

}  // namespace rollgait
