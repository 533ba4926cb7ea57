#include "client/report/scene_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "client/failure.h"
#include "client/report/body_shapes.h"
#include "client/report/kinematics.h"
#include "client/report/packed_rows.h"
#include "client/report/sides.h"

namespace rollgait::client {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using Row = std::vector<double>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Micrometres are enough for a picture.
double Short(double value) { return std::round(value * 1e6) / 1e6; }
json Numbers(const Vector3d& v) { return {Short(v.x()), Short(v.y()), Short(v.z())}; }

Pose Compose(const Pose& outer, const Pose& inner) {
  return {outer.rotation * inner.rotation, outer.position + outer.rotation * inner.position};
}

// One scene while it is filled.
class Scene {
 public:
  Scene(const v1::Model& model, const std::vector<Instant>& instants)
      : model_(model),
        shapes_(BodyShapes(model)),
        tracks_(static_cast<int>(instants.size())),
        percent_(100 / (model.total_mass_kg() * model.gravity_m_s2())) {
    for (const Instant& instant : instants) poses_.push_back(LinkPoses(model, instant.position));
    for (const std::vector<Pose>& links : poses_) centers_.push_back(CenterOfMass(links));
    origin_x_ = MeanX() - (centers_.back().x() - centers_.front().x()) / 2;
    for (std::vector<Pose>& links : poses_) {
      for (Pose& link : links) link.position.x() -= origin_x_;
    }
    for (const BodyShape& shape : shapes_) links_.try_emplace(shape.joint, static_cast<int>(links_.size()));
  }

  json Shapes() const {
    json list = json::array();
    for (const BodyShape& shape : shapes_) {
      const Eigen::Quaterniond q(shape.pose.rotation);
      list.push_back({{"part", shape.part},
                      {"link", links_.at(shape.joint)},
                      {"center", Numbers(shape.pose.position)},
                      {"rotation", {Short(q.w()), Short(q.x()), Short(q.y()), Short(q.z())}},
                      {"axes", Numbers(shape.semi_axes)},
                      {"side", static_cast<int>(shape.side)},
                      {"kind", static_cast<int>(shape.kind)}});
      if (shape.form) list.back()["form"] = shape.form->ToJson();
    }
    return list;
  }

  json Poses() const {
    std::vector<int> joints(links_.size());
    for (const auto& [joint, link] : links_) joints[link] = joint;
    PackedRows rows(static_cast<int>((poses_.size() + 1) / 2));
    for (const int joint : joints) {
      std::vector<Row> link(7);
      Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
      for (size_t i = 0; i < poses_.size(); i += 2) {
        const Pose& pose = poses_[i][joint];
        Eigen::Quaterniond q(pose.rotation);
        if (q.dot(before) < 0) q.coeffs() = -q.coeffs();
        before = q;
        const double values[] = {pose.position.x(), pose.position.y(), pose.position.z(), q.w(), q.x(), q.y(), q.z()};
        for (int k = 0; k < 7; ++k) link[k].push_back(values[k]);
      }
      for (const Row& row : link) rows.Add(row);
    }
    return rows.ToJson();
  }

  // Of contact c: where it touches the ground, on the ground and on itself, and the force there.
  json AddContact(int c, const std::vector<Instant>& instants) {
    const v1::ContactSurface& contact = model_.contacts(c);
    std::vector<Row> rows(8, Row(instants.size(), kNone));
    for (size_t i = 0; i < instants.size(); ++i) {
      if (!instants[i].active[c]) continue;
      const Vector3d point = LowestPoint(contact, poses_[i]);
      const Pose surface = Compose(poses_[i][contact.joint()], shapes_[c].pose);
      const Vector3d own = surface.rotation.transpose() * (point - surface.position);
      const auto& force = instants[i].force[c];
      const double values[] = {point.x(),           point.y(),          own.x(), own.y(), own.z(), percent_ * force[0],
                               percent_ * force[1], percent_ * force[2]};
      for (int k = 0; k < 8; ++k) rows[k][i] = values[k];
    }
    const int first = tracks_.Add(rows[0]);
    for (int k = 1; k < 8; ++k) tracks_.Add(rows[k]);
    return {{"name", shapes_[c].part}, {"side", static_cast<int>(shapes_[c].side)}, {"shape", c}, {"rows", first}};
  }

  json AddFoot(const v1::FootOnGround& foot) {
    const v1::Matrix& pressure = foot.center_of_pressure_m();
    Row x, y;
    for (int i = 0; i < pressure.rows(); ++i) {
      x.push_back(pressure.values(2 * i) - origin_x_);
      y.push_back(pressure.values(2 * i + 1));
    }
    const int first = tracks_.Add(x);
    tracks_.Add(y);
    return {{"side", static_cast<int>(foot.foot() == v1::FOOT_RIGHT ? Side::kRight : Side::kLeft)}, {"rows", first}};
  }

  int AddCenter() {
    std::vector<Row> rows(3);
    for (const Vector3d& center : centers_) {
      for (int k = 0; k < 3; ++k) rows[k].push_back(center(k) - (k == 0 ? origin_x_ : 0));
    }
    const int first = tracks_.Add(rows[0]);
    tracks_.Add(rows[1]);
    tracks_.Add(rows[2]);
    return first;
  }

  double Height() const {
    double height = 0;
    for (const std::vector<Pose>& links : poses_) {
      for (const BodyShape& shape : shapes_) {
        const Pose placed = Compose(links[shape.joint], shape.pose);
        const Vector3d up = placed.rotation.transpose().col(2);
        const SurfaceShape surface{shape.semi_axes, shape.form, ""};
        height = std::max(height, placed.position.z() + up.dot(surface.FurthestPoint(up)));
      }
    }
    return height;
  }

  json Tracks() const { return tracks_.ToJson(); }
  size_t links() const { return links_.size(); }

 private:
  // Not finite for a model without mass.
  Vector3d CenterOfMass(const std::vector<Pose>& links) const {
    Vector3d moment = Vector3d::Zero();
    double mass = 0;
    for (int j = 0; j < model_.joints_size(); ++j) {
      const v1::Joint& joint = model_.joints(j);
      mass += joint.mass_kg();
      moment += joint.mass_kg() * (links[j].position + links[j].rotation * ToVector(joint.center_of_mass_m()));
    }
    return moment / mass;
  }

  double MeanX() const {
    double sum = 0;
    for (const Vector3d& center : centers_) sum += center.x();
    return sum / static_cast<double>(centers_.size());
  }

  const v1::Model& model_;
  const std::vector<BodyShape> shapes_;
  PackedRows tracks_;
  const double percent_;  // of body weight, 1/N
  std::vector<std::vector<Pose>> poses_;
  std::vector<Vector3d> centers_;  // of mass
  std::map<int, int> links_;       // joint -> place among the links that are drawn
  double origin_x_ = 0;
};

}  // namespace

json SceneData(const std::vector<Instant>& instants, const v1::Model& model, const v1::GaitEvents& events) {
  Scene scene(model, instants);
  json contacts = json::array(), feet = json::array();
  for (int c = 0; c < model.contacts_size(); ++c) contacts.push_back(scene.AddContact(c, instants));
  for (const v1::FootOnGround& foot : events.feet()) feet.push_back(scene.AddFoot(foot));
  const int center = scene.AddCenter();
  return {{"shapes", scene.Shapes()},
          {"links", scene.links()},
          {"poses", scene.Poses()},
          {"contacts", contacts},
          {"feet", feet},
          {"center", center},
          {"tracks", scene.Tracks()},
          {"height", Short(scene.Height())}};
}

}  // namespace rollgait::client
