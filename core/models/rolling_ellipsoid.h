#ifndef ROLLGAIT_CORE_MODELS_ROLLING_ELLIPSOID_H_
#define ROLLGAIT_CORE_MODELS_ROLLING_ELLIPSOID_H_

#include "core/base/result.h"
#include "core/models/scene.h"

namespace rollgait {

// Angles of an orientation: R_WB = world · Rx(α) Ry(β) Rz(γ) · body. The axes of α and γ coincide where |β| = 90°: the
// chart ends before that, and its two rotations are chosen such that a manoeuvre stays away from there.
struct OrientationChart {
  static constexpr double kLargestTilt = 1.3;  // rad, of |β|
  Matrix3 world = Matrix3::Identity();
  Matrix3 body = Matrix3::Identity();
};

// The angles (α, β, γ) of a rotation in a chart, each within ±π (β within ±π/2). Contract: |β| is not 90°.
Vector3 ChartAngles(const OrientationChart& chart, const Matrix3& R_WB);
Matrix3 ChartRotation(const OrientationChart& chart, const Vector3& angles);
// A with ω = A (α̇, β̇, γ̇), ω in world axes. The torque M of a couple has the efforts Aᵀ M at the three joints.
Matrix3 ChartRates(const OrientationChart& chart, const Vector3& angles);

// An ellipsoid (a ball by default) on the ground, moved by a couple on the body. Joints: base_x, base_y, base_z, then
// roll_1, roll_2, roll_3 with the angles of the chart, actuated without limits; contact "surface". Violations name
// fields of rollgait.v1.ModelSelection.
Result<Scene> RollingEllipsoidScene(const RollingEllipsoidRequest& request, const OrientationChart& chart);

// The same body in another chart, and the chart of one; the limits of base_x and base_y are kept. Contract: the scene
// is one of RollingEllipsoidScene.
Scene InChart(const Scene& scene, const OrientationChart& chart);
OrientationChart ChartOf(const Scene& scene);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_ROLLING_ELLIPSOID_H_
