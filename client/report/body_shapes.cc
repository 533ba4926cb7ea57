#include "client/report/body_shapes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "client/failure.h"
#include "client/rotation_of_z.h"

namespace rollgait::client {
namespace {

using Eigen::Vector3d;

// Proportions of what is drawn only, as fractions of stature (1.774 m is that of the table of segments).
constexpr double kShoulderDepth = 0.182;  // below the vertex
constexpr double kUpperArm = 0.153;
constexpr double kStature_m = 1.774;
constexpr double kFlesh =
    0.04;  // around the joints of a trunk or pelvis that is known by them only, of the leg's length
constexpr double kMiddleThickness =
    0.35;  // of a trunk or pelvis that is known by its joints only, of its largest extent

std::string Words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// Adds what is drawn for the links of one model.
class Drawing {
 public:
  explicit Drawing(const v1::Model& model)
      : model_(model),
        sides_(JointSides(model)),
        poses_(LinkPoses(model, std::vector<double>(model.joints_size(), 0.0))),
        scale_((model.stature_m() > 0 ? model.stature_m() : kStature_m) / kStature_m) {}

  std::vector<BodyShape> Shapes() {
    std::set<std::string> contacts;
    for (const v1::ContactSurface& contact : model_.contacts()) {
      contacts.insert(contact.name());
      AddSurface(contact, ShapeKind::kContact);
    }
    for (const v1::BodySurface& body : model_.bodies()) {
      if (contacts.count(body.name()) == 0) AddSurface(body, ShapeKind::kBody);
    }
    std::set<int> covered;
    for (const BodyShape& shape : shapes_) {
      // A surface beside the middle, like a forearm that moves with the trunk, does not show the trunk.
      const bool in_middle = std::abs(shape.pose.position.y()) <= shape.semi_axes.minCoeff();
      const bool covers = sides_[shape.joint] == Side::kMiddle ? model_.stature_m() <= 0 && in_middle : !IsFar(shape);
      if (covers) covered.insert(shape.joint);
    }
    for (int i = 0; i < model_.joints_size(); ++i) {
      if (model_.joints(i).mass_kg() > 0 && covered.count(i) == 0) AddLink(i);
    }
    for (const int link : covered) {
      if (sides_[link] != Side::kMiddle && model_.stature_m() > 0 && BeginsLeg(link)) AddHip(link);
    }
    return shapes_;
  }

 private:
  template <typename Placed>
  void AddSurface(const Placed& placed, ShapeKind kind) {
    if (placed.joint() < 0 || placed.joint() >= model_.joints_size()) {
      throw Failure(ExitCode::kUsage, "surface " + placed.name() + ": the model has no joint of its index");
    }
    Side side = sides_[placed.joint()];
    const double y = placed.center_m().y();
    if (side == Side::kMiddle && y != 0 && model_.stature_m() > 0) side = y < 0 ? Side::kRight : Side::kLeft;
    const SurfaceShape shape = ShapeOf(placed.surface());
    shapes_.push_back({Words(placed.name()), placed.joint(),
                       Pose{ToRotation(placed.orientation()), ToVector(placed.center_m())}, shape.semi_axes, side, kind,
                       shape.form});
  }

  // An ellipsoid with axes along those of the link.
  void Draw(const std::string& part, int joint, const Vector3d& center, const Vector3d& semi_axes, Side side) {
    shapes_.push_back({part, joint, Pose{Eigen::Matrix3d::Identity(), center}, semi_axes, side, ShapeKind::kDrawn, {}});
  }

  // A surface far from the joint of its limb, like the point on which a shank without a foot stands, does not show the
  // limb: of the way from the joint to its far side it spans less than half, however it is turned.
  static bool IsFar(const BodyShape& shape) {
    const double distance = shape.pose.position.norm(), longest = shape.semi_axes.maxCoeff();
    return 2 * longest < (distance + longest) / 2;
  }

  // The far surface of a limb that carries one; nullptr if none does.
  const BodyShape* FarEnd(int link) const {
    const auto end = std::find_if(shapes_.begin(), shapes_.end(),
                                  [&](const BodyShape& shape) { return shape.joint == link && IsFar(shape); });
    return end == shapes_.end() ? nullptr : &*end;
  }

  // The next links with mass beyond a link.
  std::vector<int> Children(int link) const {
    std::vector<int> children;
    for (int i = link + 1; i < model_.joints_size(); ++i) {
      int parent = model_.joints(i).parent();
      while (parent > link && model_.joints(parent).mass_kg() <= 0) parent = model_.joints(parent).parent();
      if (parent == link && model_.joints(i).mass_kg() > 0) children.push_back(i);
    }
    return children;
  }

  bool CarriesFoot(int link) const {
    for (const v1::ContactSurface& contact : model_.contacts()) {
      for (int j = contact.joint(); j >= link; j = model_.joints(j).parent()) {
        if (j == link) return true;
      }
    }
    return false;
  }

  // The first link with mass of a leg.
  bool BeginsLeg(int link) const {
    int parent = model_.joints(link).parent();
    while (parent >= 0 && model_.joints(parent).mass_kg() <= 0) parent = model_.joints(parent).parent();
    return parent >= 0 && sides_[parent] == Side::kMiddle && CarriesFoot(link);
  }

  // Fills the gap between pelvis and thigh.
  void AddHip(int link) {
    const char* const part = sides_[link] == Side::kRight ? "right hip" : "left hip";
    Draw(part, link, {0, 0, -0.02 * scale_}, Vector3d(0.08, 0.072, 0.095) * scale_, sides_[link]);
  }

  // Where joint `of` is in the frame of `link`, in the zero posture.
  Vector3d Place(int of, int link) const {
    return poses_[link].rotation.transpose() * (poses_[of].position - poses_[link].position);
  }

  void AddLink(int link) {
    const std::vector<int> children = Children(link);
    if (sides_[link] != Side::kMiddle) {
      AddLimb(link, children);
      return;
    }
    if (model_.stature_m() <= 0) {
      AddMiddle(link, children);
      return;
    }
    std::vector<int> hips;
    bool has_trunk_above = false;
    for (const int child : children) {
      if (sides_[child] == Side::kMiddle)
        has_trunk_above = true;
      else if (CarriesFoot(child))
        hips.push_back(child);
    }
    if (!hips.empty()) AddPelvis(link, hips);
    if (!has_trunk_above) AddTrunk(link, children);
  }

  // Of a body whose stature is not known: around its joint, its centre of mass and the joints that it carries.
  void AddMiddle(int link, const std::vector<int>& children) {
    Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();
    const auto reach = [&](const Vector3d& place) { low = low.cwiseMin(place), high = high.cwiseMax(place); };
    reach(ToVector(model_.joints(link).center_of_mass_m()));
    for (const int child : children) reach(Place(child, link));
    const Vector3d half = (high - low) / 2 + Vector3d::Constant(kFlesh * model_.leg_length_m());
    const double thinnest = kMiddleThickness * half.maxCoeff();
    if (thinnest < 1e-3) return;
    Draw(Words(model_.joints(link).link_name()), link, (low + high) / 2, half.cwiseMax(thinnest), Side::kMiddle);
  }

  void AddLimb(int link, const std::vector<int>& children) {
    const std::string part = Words(WithoutSide(model_.joints(link).link_name()));
    const std::string name = (sides_[link] == Side::kRight ? "right " : "left ") + part;
    const BodyShape* const far_end = FarEnd(link);
    const Vector3d end = !children.empty()    ? Place(children.front(), link)
                         : far_end != nullptr ? far_end->pose.position
                                              : Vector3d(2 * ToVector(model_.joints(link).center_of_mass_m()));
    const double length = end.norm();
    if (length < 1e-3) return;
    const double radius = 0.16 * length;
    BodyShape shape{name,
                    link,
                    Pose{Eigen::Matrix3d::Identity(), end / 2},
                    {radius, radius, 0.54 * length},
                    sides_[link],
                    ShapeKind::kDrawn,
                    {}};
    shape.pose.rotation = RotationOfZTo(end);
    shapes_.push_back(shape);
  }

  void AddPelvis(int link, const std::vector<int>& hips) {
    Vector3d middle = Vector3d::Zero();
    double half_width = 0;
    for (const int hip : hips) {
      middle += Place(hip, link) / static_cast<double>(hips.size());
      half_width = std::max(half_width, std::abs(Place(hip, link).y()));
    }
    Draw("pelvis", link, middle + scale_ * Vector3d(-0.03, 0, 0.04),
         Vector3d(0.105 * scale_, half_width + 0.068 * scale_, 0.115 * scale_), Side::kMiddle);
  }

  // Height of the vertex in the frame of a link, in the upright posture.
  double Vertex(int link) const {
    double hip = poses_[link].position.z();
    for (int i = model_.joints_size() - 1; i >= 0; --i) {
      const int parent = model_.joints(i).parent();
      const bool leg = sides_[i] != Side::kMiddle && parent >= 0 && sides_[parent] == Side::kMiddle && CarriesFoot(i);
      if (leg) hip = poses_[i].position.z();
    }
    return hip + model_.stature_m() - model_.leg_length_m() - poses_[link].position.z();
  }

  void AddTrunk(int link, const std::vector<int>& children) {
    const double vertex = Vertex(link), stature = model_.stature_m();
    double shoulders = vertex - kShoulderDepth * stature, base = 0;
    bool arms = false;
    for (const int child : children) {
      if (sides_[child] == Side::kMiddle) continue;
      if (CarriesFoot(child)) {
        base = std::max(base, Place(child, link).z() + 0.075 * scale_);
      } else {
        shoulders = Place(child, link).z();
        arms = true;
      }
    }
    const double height = shoulders - base, x = model_.joints(link).center_of_mass_m().x();
    Draw("abdomen", link, {x, 0, base + 0.26 * height}, {0.1 * scale_, 0.138 * scale_, 0.42 * height}, Side::kMiddle);
    Draw("chest", link, {x, 0, base + 0.66 * height}, {0.118 * scale_, 0.172 * scale_, 0.42 * height}, Side::kMiddle);
    Draw("neck", link, {x + 0.005 * scale_, 0, shoulders + 0.06 * scale_}, Vector3d(0.052, 0.052, 0.085) * scale_,
         Side::kMiddle);
    Draw("head", link, {x + 0.02 * scale_, 0, vertex - 0.118 * scale_}, Vector3d(0.098, 0.076, 0.118) * scale_,
         Side::kMiddle);
    if (!arms) AddUpperArms(link);
  }

  // Of arms that are part of the trunk: above each forearm.
  void AddUpperArms(int link) {
    const double length = kUpperArm * model_.stature_m();
    for (const v1::BodySurface& body : model_.bodies()) {
      if (body.joint() != link || !body.name().ends_with("forearm")) continue;
      const Vector3d center = ToVector(body.center_m());
      const double elbow = center.z() + ShapeOf(body.surface()).semi_axes.z();
      const bool right = center.y() < 0;
      Draw(right ? "right upper arm" : "left upper arm", link, {center.x(), center.y(), elbow + length / 2},
           {0.16 * length, 0.16 * length, 0.54 * length}, right ? Side::kRight : Side::kLeft);
    }
  }

  const v1::Model& model_;
  const std::vector<Side> sides_;
  const std::vector<Pose> poses_;
  const double scale_;
  std::vector<BodyShape> shapes_;
};

}  // namespace

std::vector<BodyShape> BodyShapes(const v1::Model& model) { return Drawing(model).Shapes(); }

}  // namespace rollgait::client
