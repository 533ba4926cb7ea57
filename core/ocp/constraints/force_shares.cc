#include "core/ocp/constraints/force_shares.h"

#include <algorithm>
#include <map>

namespace rollgait {
namespace {

double Sum(const double* f, const std::vector<int>& offsets) {
  double sum = 0;
  for (int offset : offsets) sum += f[offset];
  return sum;
}

}  // namespace

std::unique_ptr<PointConstraint> MakeForceShares(const std::vector<ContactSurface>& contacts,
                                                 const std::vector<ActiveContact>& active, const PointLayout& layout,
                                                 double force_size) {
  std::map<int, std::vector<const ActiveContact*>> links;
  for (const ActiveContact& contact : active) {
    if (contact.directions.front() == 0) links[contacts[contact.contact].joint].push_back(&contact);
  }
  std::vector<ForceSharesConstraint::Share> shares;
  for (const auto& [link, group] : links) {
    ForceSharesConstraint::Share share;
    for (const ActiveContact* contact : group) {
      share.along.push_back(contact->offset);
      share.normal.push_back(contact->offset + static_cast<int>(contact->directions.size()) - 1);
    }
    for (size_t k = 1; k < group.size(); ++k) {
      share.own = static_cast<int>(k);
      share.name = contacts[group[k]->contact].name;
      shares.push_back(share);
    }
  }
  if (shares.empty()) return nullptr;
  return std::make_unique<ForceSharesConstraint>(std::move(shares), layout, force_size);
}

void ForceSharesConstraint::Bounds(double, double* lower, double* upper) const {
  std::fill_n(lower, rows(), -kWidth * Size(0));
  std::fill_n(upper, rows(), kWidth * Size(0));
}
Entries ForceSharesConstraint::JacobianPattern() const {
  Entries entries;
  for (int r = 0; r < rows(); ++r) {
    for (int offset : shares_[r].along) entries.emplace_back(r, layout_.force() + offset);
    for (int offset : shares_[r].normal) entries.emplace_back(r, layout_.force() + offset);
  }
  return entries;
}
Entries ForceSharesConstraint::HessianPattern() const {
  Entries entries;
  for (const Share& share : shares_) {
    for (size_t k = 0; k < share.along.size(); ++k) {
      entries.emplace_back(layout_.force() + share.along[share.own], layout_.force() + share.normal[k]);
      entries.emplace_back(layout_.force() + share.along[k], layout_.force() + share.normal[share.own]);
    }
  }
  return entries;
}
void ForceSharesConstraint::Value(const PointContext& at, double* g) {
  const double* f = at.z + layout_.force();
  for (const Share& share : shares_) {
    *g++ = f[share.along[share.own]] * Sum(f, share.normal) - f[share.normal[share.own]] * Sum(f, share.along);
  }
}
void ForceSharesConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  const double* f = at.z + layout_.force();
  for (int r = 0; r < rows(); ++r) {
    const Share& share = shares_[r];
    const double own_along = f[share.along[share.own]], own_normal = f[share.normal[share.own]];
    for (size_t k = 0; k < share.along.size(); ++k) {
      const bool own = static_cast<int>(k) == share.own;
      jacobian(r, layout_.force() + share.along[k]) = (own ? Sum(f, share.normal) : 0) - own_normal;
      jacobian(r, layout_.force() + share.normal[k]) = own_along - (own ? Sum(f, share.along) : 0);
    }
  }
}
void ForceSharesConstraint::AddHessian(const PointContext&, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  for (const Share& share : shares_) {
    const double multiplier = *lambda++;
    const auto add = [&](int along, int normal, double value) {
      const int a = layout_.force() + share.along[along], b = layout_.force() + share.normal[normal];
      hessian(a, b) += value;
      hessian(b, a) += value;
    };
    for (int k = 0; k < static_cast<int>(share.along.size()); ++k) {
      add(share.own, k, multiplier);
      add(k, share.own, -multiplier);
    }
  }
}

}  // namespace rollgait
