// Homogeneous ellipsoids that roll on a flat or tilted plane.
#include "tests/reference_check/trajectory.h"

namespace rollgait::reference {
namespace triaxial {

constexpr char kColumns[] = "t,qw,qx,qy,qz,wbx,wby,wbz,px,py,gx,gy,gz,vgx,vgy,vgz,Fx,Fy,Fz,Ekin,Epot,E";

void CheckCase(Fields item, const std::string& directory, Report* all) {
  Fields parameters = item.Object("parameters");
  const RollingCase rolling =
      ReadRollingCase(&item, GroundMotion{}, parameters.Vector3("contact_point_initial").cast<double>(), &parameters);
  parameters.Finish();
  CaseReport report(all, "triaxial", rolling.name);
  std::vector<double> growth;
  for (const Real value : item.Vector("sensitivity_amplification_at_quarters"))
    growth.push_back(static_cast<double>(value));
  const RollingRun run = CheckTable(rolling, ReadTable(directory + item.Text("file"), kColumns), growth, &report);
  const Real energy = item.Number("energy_initial");
  report.Number("energy_initial", run.report.energy_initial, energy, 100 * kEpsilon * std::abs(energy));
  // Extremes over the rows of the file.
  report.Number("min_normal_force_over_mg", run.min_normal_force / rolling.weight,
                item.Number("min_normal_force_over_mg"), 1e-6);
  report.Number("max_friction_ratio", run.max_friction_ratio, item.Number("max_friction_ratio"), 1e-6);
  item.Skip("max_abs_energy_change");              // of the reference's own integration
  item.Skip("reference_error_bound_orientation");  // the same
  item.Finish();
}

}  // namespace triaxial

bool IsTriaxial(const Document& document) {
  const Json item = TypicalCase(document);
  return item.is_object() && item.contains("min_normal_force_over_mg") && item.contains("energy_initial");
}

void CheckTriaxial(const Document& document, Report* report) {
  const Json cases = CasesOf(document);
  for (const Json& item : cases) triaxial::CheckCase(Fields(item, "case"), DirectoryOf(document.path), report);
}

}  // namespace rollgait::reference
