// Ellipsoids that roll on a plane that turns about the origin with constant angular velocity.
#include <algorithm>

#include "core/contact/contact_dynamics.h"
#include "tests/reference_check/trajectory.h"

namespace rollgait::reference {
namespace moving_plane {

constexpr char kColumns[] =
    "t,qw,qx,qy,qz,wbx,wby,wbz,px,py,pz,gx,gy,gz,vgx,vgy,vgz,Fx,Fy,Fz,nx,ny,nz,pdotx,pdoty,pdotz,Ekin,Epot";
// The files do not say how a perturbation grows. Within their 4 s, with bodies of the triaxial family's kind, it grows
// less than this.
constexpr double kGrowth = 10;

// Velocity of the geometric contact point at a sample, from the pair's kinematics.
Vector3 PointVelocity(const RollingCase& rolling, const SimulationSample& sample) {
  ContactDynamics dynamics(BodyDynamics(rolling.scene.model), {rolling.scene.contacts[0].contact});
  dynamics.SetState(sample.q, sample.v, {FrameMotion{}, MotionAt(rolling.scene.ground[1], sample.time)});
  return dynamics.Kinematics(0).p_dot_1;
}

void CheckCase(Fields item, const std::string& directory, Report* all) {
  Fields parameters = item.Object("parameters");
  const RealVectorX start = parameters.Vector("contact_point_initial_xy");
  if (start.size() != 2) throw ReadError(parameters.where() + ".contact_point_initial_xy must have 2 entries");
  const Vector3 omega = parameters.Vector3("plane_omega_world").cast<double>();
  GroundMotion ground;
  ground.rate = omega.norm();
  if (ground.rate > 0) ground.axis = omega / ground.rate;
  parameters.Skip("plane");  // says in words what plane_omega_world means
  const RollingCase rolling = ReadRollingCase(
      &item, ground, Vector3(static_cast<double>(start[0]), static_cast<double>(start[1]), 0), &parameters);
  parameters.Finish();
  CaseReport report(all, "moving_plane", rolling.name);
  const Table table = ReadTable(directory + item.Text("file"), kColumns);
  const RollingRun run = CheckTable(rolling, table, {1, kGrowth, kGrowth, kGrowth, kGrowth}, &report);
  for (size_t i = 0; i < run.samples.size(); ++i) {
    const RealVector3 expected = table.Vector(i, "pdotx", "pdoty", "pdotz");
    report.Norm("contact_point_velocity", PointVelocity(rolling, run.samples[i]), expected,
                10 * kTrajectoryTolerance * kGrowth * (1 + expected.norm()));
  }
  report.Number("min_normal_force_over_mg", run.min_normal_force / rolling.weight,
                item.Number("min_normal_force_over_mg"), 10 * kTrajectoryTolerance * kGrowth);
  item.Skip("independent_check_max_abs_difference");  // between two references
  item.Finish();
}

}  // namespace moving_plane

bool IsMovingPlane(const Document& document) {
  const Json item = TypicalCase(document);
  return item.is_object() && item["parameters"].is_object() && item["parameters"].contains("plane_omega_world");
}

void CheckMovingPlane(const Document& document, Report* report) {
  const Json cases = CasesOf(document);
  for (const Json& item : cases) moving_plane::CheckCase(Fields(item, "case"), DirectoryOf(document.path), report);
}

}  // namespace rollgait::reference
