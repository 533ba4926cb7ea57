#include "client/import/mirror_average.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/formats/body_links.h"
#include "client/report/kinematics.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Of a link, in axes of the world at position zero, seen from the world's origin.
LinkMass InWorld(const v1::Joint& joint, const Pose& place) {
  const LinkMass mass = MassOf(joint);
  return {mass.mass, place.position + place.rotation * mass.center_of_mass,
          place.rotation * mass.inertia * place.rotation.transpose()};
}

LinkMass Reflected(const LinkMass& mass) {
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
  return {mass.mass, mirror * mass.center_of_mass, mirror * mass.inertia * mirror};
}

void SetMass(const LinkMass& in_world, const Pose& place, v1::Joint* joint) {
  const Eigen::Vector3d center = place.rotation.transpose() * (in_world.center_of_mass - place.position);
  const Eigen::Matrix3d inertia = place.rotation.transpose() * in_world.inertia * place.rotation;
  joint->set_mass_kg(in_world.mass);
  joint->mutable_center_of_mass_m()->set_x(center.x());
  joint->mutable_center_of_mass_m()->set_y(center.y());
  joint->mutable_center_of_mass_m()->set_z(center.z());
  const double entries[] = {inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  for (int k = 0; k < 6; ++k) joint->set_inertia_kg_m2(k, entries[k]);
}

// The narrower of a range and that of the mirror image, which both get.
void Narrow(double sign, double min, double max, double image_min, double image_max, double* new_min, double* new_max) {
  *new_min = std::max(min, sign > 0 ? image_min : -image_max);
  *new_max = std::min(max, sign > 0 ? image_max : -image_min);
}

}  // namespace

std::string MirrorChange::Describe() const {
  return "masses by up to " + FormatNumber(100 * mass, 2) + " %, centres of mass by " + FormatNumber(1000 * center, 2) +
         " mm, inertias by " + FormatNumber(100 * inertia, 2) + " %, limits by " + FormatNumber(limits, 2);
}

bool MirrorChange::IsSmall() const { return mass <= 0.05 && center <= 0.02 && inertia <= 0.25; }

MirrorChange AverageMirrorImages(v1::Model* model) {
  const std::vector<Pose> poses =
      LinkPoses(*model, std::vector<double>(static_cast<size_t>(model->joints_size()), 0.0));
  MirrorChange change;
  for (int i = 0; i < model->joints_size(); ++i) {
    v1::Joint& joint = *model->mutable_joints(i);
    const int j = joint.mirror_joint();
    if (j < i) continue;
    v1::Joint& image = *model->mutable_joints(j);
    const LinkMass ours = InWorld(joint, poses[static_cast<size_t>(i)]);
    const LinkMass other = Reflected(InWorld(image, poses[static_cast<size_t>(j)]));
    if (ours.mass > 0 && other.mass > 0) {
      const double sum = ours.mass + other.mass;
      const LinkMass mean{sum / 2, (ours.mass * ours.center_of_mass + other.mass * other.center_of_mass) / sum,
                          (ours.inertia + other.inertia) / 2};
      for (const LinkMass& one : {ours, other}) {
        change.mass = std::max(change.mass, std::abs(mean.mass - one.mass) / one.mass);
        change.center = std::max(change.center, (mean.center_of_mass - one.center_of_mass).norm());
        if (one.inertia.norm() > 0) {
          change.inertia = std::max(change.inertia, (mean.inertia - one.inertia).norm() / one.inertia.norm());
        }
      }
      SetMass(mean, poses[static_cast<size_t>(i)], &joint);
      SetMass(Reflected(mean), poses[static_cast<size_t>(j)], &image);
    }
    const double sign = joint.mirror_sign();
    double min = 0, max = 0;
    const auto cut = [&](double before, double after) {
      if (std::isfinite(before)) change.limits = std::max(change.limits, std::abs(before - after));
    };
    const auto both = [&](auto get_min, auto get_max, auto set) {
      Narrow(sign, get_min(joint), get_max(joint), get_min(image), get_max(image), &min, &max);
      for (v1::Joint* one : {&joint, &image}) {
        const double low = one == &joint || sign > 0 ? min : -max, high = one == &joint || sign > 0 ? max : -min;
        cut(get_min(*one), low);
        cut(get_max(*one), high);
        set(one, low, high);
        if (&joint == &image) break;
      }
    };
    both([](const v1::Joint& one) { return one.position_min(); },
         [](const v1::Joint& one) { return one.position_max(); },
         [](v1::Joint* one, double low, double high) {
           one->set_position_min(low);
           one->set_position_max(high);
         });
    both([](const v1::Joint& one) { return one.effort_min(); }, [](const v1::Joint& one) { return one.effort_max(); },
         [](v1::Joint* one, double low, double high) {
           one->set_effort_min(low);
           one->set_effort_max(high);
         });
    const double velocity = std::min(joint.velocity_max(), image.velocity_max());
    cut(joint.velocity_max(), velocity);
    cut(image.velocity_max(), velocity);
    joint.set_velocity_max(velocity);
    image.set_velocity_max(velocity);
    const double stiffness = (joint.stiffness() + image.stiffness()) / 2;
    const double rest = (joint.rest_position() + sign * image.rest_position()) / 2;
    const double damping = (joint.damping() + image.damping()) / 2;
    for (v1::Joint* one : {&joint, &image}) {
      one->set_stiffness(stiffness);
      one->set_rest_position(one == &joint ? rest : sign * rest);
      one->set_damping(damping);
    }
  }
  return change;
}

}  // namespace rollgait::client
