#include "core/ocp/constraints/friction.h"

#include <algorithm>
#include <cmath>

namespace rollgait {

std::vector<ForceRow> FrictionRows(const std::vector<ContactSurface>& contacts,
                                   const std::vector<ActiveContact>& active, double coefficient) {
  std::vector<ForceRow> rows;
  for (const ActiveContact& contact : active) {
    const ContactSurface& surface = contacts[contact.contact];
    const bool alone = std::none_of(active.begin(), active.end(), [&](const ActiveContact& other) {
      return other.contact != contact.contact && contacts[other.contact].joint == surface.joint;
    });
    const double mu = surface.directions.size() > 2 ? coefficient / std::sqrt(2.0) : coefficient;
    const int normal = contact.offset + static_cast<int>(contact.directions.size()) - 1;
    for (int d = 0; d + 1 < static_cast<int>(contact.directions.size()); ++d) {
      for (const bool positive : {true, false}) {
        rows.push_back({"friction " + surface.name,
                        {{normal, mu}, {contact.offset + d, positive ? 1 : -1}},
                        contact.contact,
                        positive,
                        !alone && contact.directions[d] == 0});
      }
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
