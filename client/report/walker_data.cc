#include "client/report/walker_data.h"

#include <algorithm>
#include <cmath>

#include "client/report/kinematics.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

// Five significant digits: less than a pixel, and a third of the size.
json Rounded(double value) {
  if (!std::isfinite(value)) return json();
  if (value == 0) return 0;
  const double scale = std::pow(10.0, 4 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
  if (!std::isfinite(scale)) return value;
  return std::round(value * scale) / scale;
}

// Metres at a tenth of a millimetre.
json Place(double metres) { return std::round(metres * 1e4) / 1e4; }

enum Side { kMiddle = 0, kReference = 1, kOther = 2 };

// A contact on a joint whose name ends in "_r", else the first one; -1 without contacts.
int ReferenceContact(const v1::Model& model) {
  for (int c = 0; c < model.contacts_size(); ++c) {
    if (model.joints(model.contacts(c).joint()).name().ends_with("_r")) return c;
  }
  return model.contacts_size() > 0 ? 0 : -1;
}

// The side of each joint: lateral joints have another joint as their mirror image; the reference side is the right one.
std::vector<Side> Sides(const v1::Model& model) {
  const int reference_contact = ReferenceContact(model);
  std::vector<Side> sides(model.joints_size(), kMiddle);
  for (int i = 0; i < model.joints_size(); ++i) {
    if (model.joints(i).mirror_joint() != i) sides[i] = kOther;
  }
  if (reference_contact < 0) return sides;
  const int foot = model.contacts(reference_contact).joint();
  for (int i = 0; i < model.joints_size(); ++i) {
    if (sides[i] != kOther) continue;
    // On the reference side if the foot hangs on the joint, or the joint on something that carries the foot.
    for (int j = foot; j >= 0; j = model.joints(j).parent()) {
      if (j == i) sides[i] = kReference;
    }
    const int parent = model.joints(i).parent();
    if (parent >= 0 && sides[parent] == kReference) sides[i] = kReference;
  }
  return sides;
}

std::vector<int> ShownJoints(const v1::Model& model, const std::vector<Side>& sides) {
  std::vector<int> shown;
  for (const char* const name : {"hip_r", "knee_r", "ankle_r"}) {
    for (int i = 0; i < model.joints_size(); ++i) {
      if (model.joints(i).name() == name) shown.push_back(i);
    }
  }
  if (!shown.empty()) return shown;
  for (const bool any_side : {false, true}) {
    for (int i = 0; i < model.joints_size() && (!any_side || shown.empty()); ++i) {
      if (model.joints(i).actuated() && (any_side || sides[i] == kReference)) shown.push_back(i);
    }
    if (!shown.empty()) break;
  }
  return shown;
}

std::string Title(const std::string& joint) {
  if (joint == "base_pitch") return "trunk pitch";
  const bool right = joint.size() > 2 && joint.compare(joint.size() - 2, 2, "_r") == 0;
  return right ? joint.substr(0, joint.size() - 2) : joint;
}

template <typename Value>
json Curve(const Stride& stride, const v1::Model& model, int joint, const Value& value) {
  json values = json::array();
  for (const StrideSample& sample : stride.samples) values.push_back(Rounded(value(sample.instant)));
  const std::string& name = model.joints(joint).name();
  return {{"joint", name}, {"title", Title(name)}, {"positive", PositiveDirection(model, joint)}, {"values", values}};
}

json Contacts(const v1::Model& model, const std::vector<Side>& sides) {
  json contacts = json::array();
  for (const v1::ContactSurface& contact : model.contacts()) {
    contacts.push_back({{"name", contact.name()}, {"right", sides[contact.joint()] == kReference}});
  }
  return contacts;
}

// What is drawn besides the joints: the far end of a link with mass that neither carries a foot nor reaches to another
// joint, at twice the height of its mass centre (a uniform rod from the joint would have its mass centre there).
std::vector<int> OpenLinks(const v1::Model& model) {
  std::vector<int> open;
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    const double reach = std::hypot(joint.center_of_mass_m().x(), joint.center_of_mass_m().z());
    bool closed = joint.mass_kg() <= 0 || reach < 1e-3;
    for (const v1::ContactSurface& contact : model.contacts()) closed = closed || contact.joint() == i;
    for (const v1::Joint& child : model.joints()) {
      closed = closed || (child.parent() == i && std::hypot(child.origin_m().x(), child.origin_m().z()) > 0.3 * reach);
    }
    if (!closed) open.push_back(i);
  }
  return open;
}

Eigen::Vector3d CenterOfMass(const v1::Joint& joint) {
  return {joint.center_of_mass_m().x(), joint.center_of_mass_m().y(), joint.center_of_mass_m().z()};
}

// Pairs of point indices; points are the joints, then the ends of the open links, then the centres of the feet.
json Segments(const v1::Model& model, const std::vector<Side>& sides, const std::vector<int>& open) {
  json segments = json::array();
  for (int i = 0; i < model.joints_size(); ++i) {
    const int parent = model.joints(i).parent();
    if (parent >= 0 && model.joints(parent).mass_kg() > 0) segments.push_back({parent, i, sides[parent]});
  }
  int point = model.joints_size();
  for (const int link : open) segments.push_back({link, point++, sides[link]});
  for (const v1::ContactSurface& contact : model.contacts()) {
    segments.push_back({contact.joint(), point++, sides[contact.joint()]});
  }
  return segments;
}

json Walker(const Stride& stride, const v1::Model& model, const std::vector<Side>& sides) {
  const std::vector<int> open = OpenLinks(model);
  const double percent = 100.0 / (model.total_mass_kg() * model.gravity_m_s2());
  json points = json::array(), feet = json::array(), centers = json::array();
  double origin = 0, height = 0;
  for (const StrideSample& sample : stride.samples) {
    const std::vector<Pose> poses = LinkPoses(model, sample.instant.position);
    if (points.empty()) origin = poses.back().position.x();
    json frame = json::array(), frame_feet = json::array();
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double mass = 0;
    const auto add = [&](double x, double z) {
      frame.push_back(Place(x - origin));
      frame.push_back(Place(z));
      height = std::max(height, z);
    };
    for (int i = 0; i < model.joints_size(); ++i) {
      add(poses[i].position.x(), poses[i].position.z());
      mass += model.joints(i).mass_kg();
      moment += model.joints(i).mass_kg() * (poses[i].position + poses[i].rotation * CenterOfMass(model.joints(i)));
    }
    for (const int link : open) {
      const Eigen::Vector3d end = poses[link].position + 2 * poses[link].rotation * CenterOfMass(model.joints(link));
      add(end.x(), end.z());
    }
    for (int c = 0; c < model.contacts_size(); ++c) {
      const Outline o = SurfaceOutline(model.contacts(c), poses);
      const auto& force = sample.instant.force[c];
      add(o.x, o.z);
      frame_feet.push_back({Place(o.x - origin), Place(o.z), Place(o.semi_a), Place(o.semi_b), Place(o.angle_rad),
                            Place(o.lowest_x - origin), Place(o.lowest_z), Rounded(percent * force[0]),
                            Rounded(percent * force[2])});
    }
    if (mass > 0) centers.push_back({Place(moment.x() / mass - origin), Place(moment.z() / mass)});
    points.push_back(frame);
    feet.push_back(frame_feet);
  }
  json foot_sides = json::array();
  for (const v1::ContactSurface& contact : model.contacts()) foot_sides.push_back(sides[contact.joint()]);
  return {{"points", points},  {"segments", Segments(model, sides, open)},
          {"feet", feet},      {"foot_sides", foot_sides},
          {"center", centers}, {"height", Place(height)}};
}

}  // namespace

json ModelData(const v1::Model& model) {
  json joints = json::array();
  for (const v1::Joint& joint : model.joints()) {
    const bool angle = joint.type() != v1::Joint::TYPE_PRISMATIC;
    const double scale = angle ? 180 / kPi : 1;
    const bool bounded = joint.position_max() - joint.position_min() < 1e6;
    joints.push_back({{"name", joint.name()},
                      {"link", joint.link_name()},
                      {"mass", joint.mass_kg()},
                      {"iyy", joint.inertia_kg_m2_size() == 6 ? json(joint.inertia_kg_m2(1)) : json()},
                      {"angle", angle},
                      {"min", bounded ? json(joint.position_min() * scale) : json()},
                      {"max", bounded ? json(joint.position_max() * scale) : json()},
                      {"effort", joint.actuated() ? json(joint.effort_max()) : json()}});
  }
  json contacts = json::array();
  for (const v1::ContactSurface& contact : model.contacts()) {
    const v1::Vector3& axes = contact.surface().ellipsoid().semi_axes_m();
    contacts.push_back({{"name", contact.name()}, {"semi_axes", {axes.x(), axes.y(), axes.z()}}});
  }
  return {{"name", model.summary().name()},
          {"description", model.summary().description()},
          {"mass", model.total_mass_kg()},
          {"stature", model.stature_m()},
          {"leg_length", model.leg_length_m()},
          {"gravity", model.gravity_m_s2()},
          {"joints", joints},
          {"contacts", contacts},
          {"sources", std::vector<std::string>(model.sources().begin(), model.sources().end())}};
}

json StrideData(const Stride& stride, const v1::Model& model) {
  const std::vector<Side> sides = Sides(model);
  json data = {{"duration", stride.duration_s}, {"displacement", stride.displacement_m}};
  for (const StrideSample& sample : stride.samples) data["percent"].push_back(sample.percent);
  for (const char* const key : {"angles", "torques", "powers"}) data[key] = json::array();
  for (const int i : ShownJoints(model, sides)) {
    const double scale = model.joints(i).type() == v1::Joint::TYPE_PRISMATIC ? 1.0 : 180 / kPi;
    data["angles"].push_back(Curve(stride, model, i, [&](const Instant& at) { return scale * at.position[i]; }));
    data["torques"].push_back(Curve(stride, model, i, [i](const Instant& at) { return at.effort[i]; }));
    data["powers"].push_back(Curve(stride, model, i, [i](const Instant& at) { return at.effort[i] * at.velocity[i]; }));
  }
  for (int i = 0; i < model.joints_size(); ++i) {
    if (model.joints(i).actuated() || model.joints(i).type() == v1::Joint::TYPE_PRISMATIC) continue;
    data["angles"].push_back(Curve(stride, model, i, [i](const Instant& at) { return at.position[i] * 180 / kPi; }));
  }
  data["contacts"] = Contacts(model, sides);
  data["walker"] = Walker(stride, model, sides);
  return data;
}

}  // namespace rollgait::client
