#ifndef ROLLGAIT_TESTS_REFERENCE_CHECK_TRAJECTORY_H_
#define ROLLGAIT_TESTS_REFERENCE_CHECK_TRAJECTORY_H_

#include <string>
#include <vector>

#include "core/simulation/simulation.h"
#include "tests/reference_check/families.h"

namespace rollgait::reference {

// What the families of rolling bodies (rattleback, triaxial, moving_plane) share: a list of cases in a .json file, each
// with a .csv file of samples beside it.

// Local tolerance that trajectories are judged by: the README of the reference data allows about 10 times it, times the
// growth of a perturbation. The integration itself is held ten times finer, so that the sum over thousands of steps
// stays within.
inline constexpr double kTrajectoryTolerance = 1e-12;

// Samples of a .csv file. Throws ReadError unless the header is `columns`, comma separated.
struct Table {
  std::vector<std::string> columns;
  std::vector<RealVectorX> rows;
  RealVector3 Vector(size_t row, const std::string& x, const std::string& y, const std::string& z) const;
  Real Number(size_t row, const std::string& column) const;
};
Table ReadTable(const std::string& path, const std::string& columns);

// The body of a case: read from its "parameters", fields common to the three families marked as known.
struct RollingCase {
  std::string name;
  SimulationScene scene;
  Matrix3 axes;         // unused directions are zero
  double size;          // m, largest semi-axis
  double mass, weight;  // kg, N
  double step;          // s, between rows of the table
};
// `ground` moves the plane; `contact` is the contact point at t = 0.
RollingCase ReadRollingCase(Fields* item, const GroundMotion& ground, const Vector3& contact, Fields* parameters);

// Simulates and compares every column of the table. `growth[i]`: of a perturbation until i quarters of the time.
// Returns the samples and the report for what else a family looks at.
struct RollingRun {
  std::vector<SimulationSample> samples;
  SimulationReport report;
  double min_normal_force = 0, max_friction_ratio = 0;  // over the samples
};
RollingRun CheckTable(const RollingCase& rolling, const Table& table, const std::vector<double>& growth,
                      CaseReport* report);

// Growth until time t.
double GrowthAt(const std::vector<double>& growth, double t, double end);

// Directory of a path, with the slash; empty if it has none.
std::string DirectoryOf(const std::string& path);

// For a .csv file: the case in a .json file beside it that names it as its "file"; null if there is none. For a .json
// file: the first case, to recognise the family by; null if the file is not a list of cases with parameters.
Json TypicalCase(const Document& document);
// The cases to check: one for a .csv file, all of a .json file.
Json CasesOf(const Document& document);

}  // namespace rollgait::reference

#endif  // ROLLGAIT_TESTS_REFERENCE_CHECK_TRAJECTORY_H_
