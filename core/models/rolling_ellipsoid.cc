#include "core/models/rolling_ellipsoid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace rollgait {
namespace {

constexpr double kSizeMin = 0.01, kSizeMax = 10;           // m
constexpr double kBodyMassMin = 1e-3, kBodyMassMax = 1e6;  // kg
constexpr double kRatioMax = 20;                           // of the semi-axes

Matrix3 Rotation(double angle, const Vector3& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

template <typename Value>
void Refuse(const char* field, const Value& value, const std::string& rule, Violations* violations) {
  std::ostringstream message;
  message << "is " << value << "; " << rule;
  violations->push_back({std::string("rolling_body.") + field, message.str()});
}

bool Within(const Vector3& values, double min, double max) {
  return values.allFinite() && values.minCoeff() >= min && values.maxCoeff() <= max;
}

// `has_moments`: they are given, and do not follow from mass and semi-axes.
Violations Check(const RollingEllipsoid& body, bool has_moments) {
  Violations violations;
  if (!Within(body.semi_axes, kSizeMin, kSizeMax)) {
    Refuse("semi_axes_m", body.semi_axes.transpose(), "each must be between 0.01 and 10 m", &violations);
  } else if (body.semi_axes.maxCoeff() > kRatioMax * body.semi_axes.minCoeff()) {
    Refuse("semi_axes_m", body.semi_axes.transpose(), "the longest may be at most 20 times the shortest", &violations);
  }
  if (!(body.mass >= kBodyMassMin && body.mass <= kBodyMassMax)) {
    Refuse("mass_kg", body.mass, "must be between 0.001 and 1e6 kg", &violations);
  }
  const Vector3& moments = body.moments;
  if (!has_moments) return violations;
  if (!moments.allFinite() || moments.minCoeff() <= 0) {
    Refuse("moments_kg_m2", moments.transpose(), "each must be finite and larger than 0", &violations);
  } else if (moments.sum() < 2 * moments.maxCoeff()) {
    Refuse("moments_kg_m2", moments.transpose(),
           "no rigid body has them: the sum of the two smaller must reach the largest", &violations);
  }
  return violations;
}

Model BuildModel(const RollingEllipsoid& body, const OrientationChart& chart) {
  constexpr JointRole kRoles[] = {JointRole::kBaseForward, JointRole::kBaseLateral, JointRole::kBaseVertical};
  const char* const names[] = {"base_x", "base_y", "base_z", "roll_1", "roll_2", "roll_3"};
  std::vector<Joint> joints(6);
  for (int i = 0; i < 6; ++i) {
    Joint& joint = joints[i];
    joint.name = names[i];
    if (i < 3) joint.role = kRoles[i];
    joint.link = i < 5 ? joint.name + "_link" : "body";
    joint.type = i < 3 ? JointType::kPrismatic : JointType::kRevolute;
    joint.axis = Vector3::Unit(i % 3);
    joint.parent = i - 1;
    joint.actuated = i >= 3;
    if (joint.actuated) joint.effort_max = kInfinity;
    joint.effort_min = -joint.effort_max;
    // The mirror image at the plane y = 0: of positions along y, of rotations about x and z.
    joint.mirror_sign = i == 1 || i == 3 || i == 5 ? -1 : 1;
  }
  joints[3].R_PJ = chart.world;
  joints[4].position_min = -OrientationChart::kLargestTilt;
  joints[4].position_max = OrientationChart::kLargestTilt;
  joints[5].mass = body.mass;
  joints[5].inertia = chart.body * body.moments.asDiagonal() * chart.body.transpose();
  joints[5].inertia = (joints[5].inertia + joints[5].inertia.transpose()).eval() / 2;
  Result<Model> model = Model::Create(std::move(joints));
  ROLLGAIT_CHECK(model.ok());
  return std::move(model).value();
}

Scene BuildChecked(const BodySelection& selection, const OrientationChart& chart) {
  const RollingEllipsoid& body = *selection.rolling_body;
  ContactSurface surface;
  surface.name = "surface";
  surface.joint = 5;
  surface.surface = Ellipsoid(body.semi_axes);
  surface.R_LE = chart.body;
  return Scene{
      .name = selection.model,
      .description = "Rigid ellipsoid, a ball by default, that rolls on the ground, moved by a couple.",
      .selection = selection,
      .model = BuildModel(body, chart),
      .contacts = {surface},
      .leg_length = body.semi_axes.z(),
      .sources = {"semi-axes, mass and moments: of the request; by default a homogeneous solid ball of 0.1 m, 1 kg"},
      .symmetric = chart.world.isIdentity(0) && chart.body.isIdentity(0)};
}

}  // namespace

Vector3 ChartAngles(const OrientationChart& chart, const Matrix3& R_WB) {
  const Matrix3 R = chart.world.transpose() * R_WB * chart.body.transpose();
  return {std::atan2(-R(1, 2), R(2, 2)), std::asin(std::clamp(R(0, 2), -1.0, 1.0)), std::atan2(-R(0, 1), R(0, 0))};
}

Matrix3 ChartRotation(const OrientationChart& chart, const Vector3& angles) {
  return chart.world * Rotation(angles(0), Vector3::UnitX()) * Rotation(angles(1), Vector3::UnitY()) *
         Rotation(angles(2), Vector3::UnitZ()) * chart.body;
}

Matrix3 ChartRates(const OrientationChart& chart, const Vector3& angles) {
  const Matrix3 first = chart.world * Rotation(angles(0), Vector3::UnitX());
  Matrix3 rates;
  rates << chart.world.col(0), first.col(1), (first * Rotation(angles(1), Vector3::UnitY())).col(2);
  return rates;
}

Result<Scene> RollingEllipsoidScene(const RollingEllipsoidRequest& request, const OrientationChart& chart) {
  RollingEllipsoid body;
  body.semi_axes = request.semi_axes.value_or(Vector3::Constant(0.1));
  body.mass = request.mass.value_or(1);
  const Vector3 squares = body.semi_axes.cwiseAbs2();
  body.moments = request.moments.value_or(body.mass / 5 * (Vector3::Constant(squares.sum()) - squares));
  Violations violations = Check(body, request.moments.has_value());
  if (!violations.empty()) return violations;
  BodySelection selection;
  selection.model = "ball";
  selection.rolling_body = body;
  return BuildChecked(selection, chart);
}

Scene InChart(const Scene& scene, const OrientationChart& chart) {
  ROLLGAIT_CHECK(scene.selection.rolling_body.has_value());
  Scene turned = BuildChecked(scene.selection, chart);
  std::vector<Joint> joints = turned.model.joints();
  std::copy_n(scene.model.joints().begin(), 3, joints.begin());
  turned.model = Model::Create(std::move(joints)).value();
  return turned;
}

OrientationChart ChartOf(const Scene& scene) {
  ROLLGAIT_CHECK(scene.selection.rolling_body.has_value());
  return {scene.model.joint(3).R_PJ, scene.contacts.front().R_LE};
}

}  // namespace rollgait
