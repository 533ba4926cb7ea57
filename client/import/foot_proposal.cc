#include "client/import/foot_proposal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "client/import/mirror_names.h"

namespace rollgait::client {
namespace {

void SetVector(const Eigen::Vector3d& from, v1::Vector3* to) {
  const auto rounded = [](double value) { return std::round(value * 1e12) / 1e12 + 0.0; };
  to->set_x(rounded(from.x()));
  to->set_y(rounded(from.y()));
  to->set_z(rounded(from.z()));
}

v1::Vector3* SemiAxes(v1::SideContact* contact) {
  return contact->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m();
}

}  // namespace

std::vector<StandingPart> StandingParts(const LinkTree& tree, const TreePosture& posture, const std::vector<int>& chain,
                                        double leg) {
  constexpr double kAsLow = 0.02;  // of the leg; a shank ends at the ankle, some 8 % above the sole
  std::vector<StandingPart> parts;
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    const auto extent = ExtentOf(tree, posture, LinksMovedBy(posture, *joint));
    if (!extent && LinksMovedBy(posture, *joint).size() == 1 && !parts.empty()) {
      // A joint of several axes has links without shapes between them.
      if (tree.links[static_cast<size_t>(tree.joints[static_cast<size_t>(*joint)].child)].mass.mass == 0) continue;
    }
    if (!extent || (!parts.empty() && extent->least.z() > parts.back().extent.least.z() + kAsLow * leg)) break;
    parts.push_back({*joint, *extent, v1::ContactSurface::FOOT_PART_WHOLE});
  }
  std::reverse(parts.begin(), parts.end());
  // Toes that are turned up do not stand.
  const auto lowest = std::min_element(parts.begin(), parts.end(), [](const StandingPart& a, const StandingPart& b) {
    return a.extent.least.z() < b.extent.least.z();
  });
  if (parts.size() < 2) return parts;
  const double ground = lowest->extent.least.z();
  while (parts.size() > 1 && parts.back().extent.least.z() > ground + kAsLow * leg) parts.pop_back();
  if (parts.size() < 2) return parts;
  parts = {parts.front(), parts.back()};
  parts.front().part = v1::ContactSurface::FOOT_PART_HEEL;
  parts.back().part = v1::ContactSurface::FOOT_PART_TOE;
  return parts;
}

v1::SideContact ContactOf(const std::string& name, const std::string& link, const Pose& place,
                          const FittedEllipsoid& foot) {
  v1::SideContact contact;
  contact.set_name(name);
  contact.set_link(link);
  SetVector(foot.semi_axes, SemiAxes(&contact));
  SetVector(place.rotation.transpose() * (foot.center - place.position), contact.mutable_center_m());
  if (const Eigen::Matrix3d to_link = place.rotation.transpose(); !to_link.isIdentity(1e-12)) {
    const Eigen::Quaterniond q(to_link);
    v1::Quaternion& to = *contact.mutable_orientation();
    to.set_w(q.w());
    to.set_x(q.x());
    to.set_y(q.y());
    to.set_z(q.z());
  }
  return contact;
}

void AddFeetPairs(v1::ModelSideFile* side) {
  const int contacts = side->contacts_size();
  for (int i = 0; i < contacts; ++i) {
    const std::string other = MirrorNameOf(side->contacts(i).name()).other;
    for (int k = 0; k < i; ++k) {
      if (side->contacts(k).name() != other) continue;
      // Equal to the bit, as mirror images must be.
      const Eigen::Vector3d first = ToVector(*SemiAxes(side->mutable_contacts(k)));
      v1::Vector3& second = *SemiAxes(side->mutable_contacts(i));
      if ((first - ToVector(second)).norm() < 1e-5) SetVector(first, &second);
    }
  }
  if (side->base() == v1::ModelSideFile::BASE_PLANE) return;  // there legs pass each other without a way around
  for (const v1::SideContact& contact : side->contacts()) {
    v1::SideBody& body = *side->add_bodies();
    body.set_name(contact.name());
    body.set_link(contact.link());
    *body.mutable_surface() = contact.surface();
    *body.mutable_center_m() = contact.center_m();
    if (contact.has_orientation()) *body.mutable_orientation() = contact.orientation();
  }
  for (const v1::SideContact& first : side->contacts()) {
    for (const v1::SideContact& second : side->contacts()) {
      if (first.side() != v1::BODY_SIDE_LEFT || second.side() != v1::BODY_SIDE_RIGHT) continue;
      v1::BodyPair& pair = *side->add_body_pairs();
      pair.set_first(first.name());
      pair.set_second(second.name());
      pair.set_usual(true);
    }
  }
}

}  // namespace rollgait::client
