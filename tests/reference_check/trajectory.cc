#include "tests/reference_check/trajectory.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/rolling_scenes.h"

namespace rollgait::reference {
namespace {

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

Table ReadTable(const std::string& path, const std::string& columns) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw ReadError(path + " cannot be read");
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (line != columns) throw ReadError(path + " has columns " + line + ", known are " + columns);
  Table table;
  table.columns = Cells(line);
  while (std::getline(file, line)) {
    if (line.empty()) continue;
    const std::vector<std::string> cells = Cells(line);
    if (cells.size() != table.columns.size()) throw ReadError(path + " has a row of another length");
    RealVectorX row(static_cast<int>(cells.size()));
    for (size_t i = 0; i < cells.size(); ++i)
      row[static_cast<int>(i)] = ParseReal(cells[i], path + " " + table.columns[i]);
    table.rows.push_back(row);
  }
  if (table.rows.size() < 2) throw ReadError(path + " has less than two rows");
  return table;
}

Real Table::Number(size_t row, const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return rows[row][found - columns.begin()];
}

RealVector3 Table::Vector(size_t row, const std::string& x, const std::string& y, const std::string& z) const {
  return {Number(row, x), Number(row, y), z.empty() ? 0 : Number(row, z)};
}

std::string DirectoryOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

Json CasesOf(const Document& document) {
  if (!document.json.is_null()) return document.json;
  const std::string directory = DirectoryOf(document.path), name = document.path.substr(directory.size());
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory.empty() ? "." : directory, error)) {
    if (entry.path().extension() != ".json") continue;
    const Json cases = ReadDocument(entry.path().string()).json;
    if (!cases.is_array()) continue;
    for (const Json& item : cases) {
      if (item.is_object() && item.contains("file") && item["file"] == name) return Json::array({item});
    }
  }
  return Json();
}

Json TypicalCase(const Document& document) {
  if (document.json.is_null() && !EndsWith(document.path, ".csv")) return Json();
  const Json cases = CasesOf(document);
  if (!cases.is_array() || cases.empty() || !cases[0].is_object() || !cases[0].contains("parameters")) return Json();
  return cases[0];
}

RollingCase ReadRollingCase(Fields* item, const GroundMotion& ground, const Vector3& contact, Fields* parameters) {
  BodyOnPlane body;
  const Vector3 axes = parameters->Vector3("semi_axes").cast<double>();
  if (!(axes.minCoeff() > 0)) throw ReadError(parameters->where() + ".semi_axes must be > 0");
  body.surface = Ellipsoid(axes);
  body.mass = parameters->Double("mass");
  body.center_of_mass = parameters->Vector3("com_in_body").cast<double>();
  const RealVectorX inertia = parameters->Vector("inertia_at_com_body_xx_yy_zz_xy_yz_xz");
  if (inertia.size() != 6) throw ReadError(parameters->where() + ": the inertia must have 6 entries");
  const Eigen::VectorXd e = inertia.cast<double>();
  body.inertia << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
  body.gravity = parameters->Vector3("gravity_world").cast<double>();
  body.sigma = parameters->Double("viscous_sigma");
  body.ground = ground;
  body.orientation = Eigen::Quaterniond(Matrix3(parameters->Rotation("quat_wxyz_initial").cast<double>()));
  body.omega_body = parameters->Vector3("omega_body_initial").cast<double>();
  body.contact_point = contact;
  RollingCase rolling{item->Text("name"),      SceneOf(body), Matrix3::Zero(),
                      axes.maxCoeff(),         body.mass,     body.mass * body.gravity.norm(),
                      parameters->Double("dt")};
  rolling.scene.options.duration = parameters->Double("t_end");
  rolling.scene.options.output_step = rolling.step;
  rolling.scene.options.tolerance = 0.1 * kTrajectoryTolerance;
  const Violations wrong = CheckScene(rolling.scene);
  if (!wrong.empty()) throw ReadError(item->where() + ": " + wrong[0].field + " " + wrong[0].message);
  return rolling;
}

double GrowthAt(const std::vector<double>& growth, double t, double end) {
  const auto quarter = static_cast<size_t>(std::clamp(std::ceil(4 * t / end - 1e-9), 0.0, 4.0));
  double worst = 1;
  for (size_t i = 0; i <= quarter && i < growth.size(); ++i) worst = std::max(worst, growth[i]);
  return worst;
}

RollingRun CheckTable(const RollingCase& rolling, const Table& table, const std::vector<double>& growth,
                      CaseReport* report) {
  RollingRun run;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    run.samples.push_back(sample);
    return true;
  };
  Result<SimulationReport> result = Simulate(rolling.scene, observer);
  if (!result.ok())
    throw ReadError(rolling.name + ": " + result.violations()[0].field + " " + result.violations()[0].message);
  run.report = result.value();
  if (run.samples.size() != table.rows.size())
    throw ReadError(rolling.name + ": t_end, dt and the rows of its file disagree");
  const Joint& link = rolling.scene.model.joint(0);
  const bool moving = std::find(table.columns.begin(), table.columns.end(), "nx") != table.columns.end();
  double fastest = 0, farthest = rolling.size;
  run.min_normal_force = kInfinity;
  for (const SimulationSample& sample : run.samples) {
    const ContactSample& contact = sample.contacts[0];
    run.min_normal_force = std::min(run.min_normal_force, contact.normal.dot(contact.force));
    run.max_friction_ratio = std::max(run.max_friction_ratio, contact.friction_ratio);
  }
  for (const SimulationSample& sample : run.samples) {
    fastest = std::max(fastest, sample.v.head<3>().norm());
    farthest = std::max(farthest, sample.q.tail<3>().norm());
  }
  const double rate = fastest + std::sqrt(rolling.scene.gravity.norm() / rolling.size);
  for (size_t i = 0; i < run.samples.size(); ++i) {
    const SimulationSample& sample = run.samples[i];
    const ContactSample& contact = sample.contacts[0];
    const Real unit = 10 * kTrajectoryTolerance * GrowthAt(growth, sample.time, rolling.scene.options.duration);
    const Eigen::Quaterniond q(sample.q[0], sample.q[1], sample.q[2], sample.q[3]);
    const Vector3 arm = q * link.center_of_mass, omega = q * Vector3(sample.v.head<3>());
    const Vector3 velocity = q * Vector3(sample.v.segment<3>(3)) + omega.cross(arm);
    const Eigen::Quaternion<Real> expected(table.Number(i, "qw"), table.Number(i, "qx"), table.Number(i, "qy"),
                                           table.Number(i, "qz"));
    report->Number("t", sample.time, table.Number(i, "t"), 4 * kEpsilon * (1 + sample.time));
    report->Norm("rotation", q.toRotationMatrix(), expected.normalized().toRotationMatrix(), unit);
    report->Norm("omega_body", Vector3(sample.v.head<3>()), table.Vector(i, "wbx", "wby", "wbz"), unit * rate);
    RealVector3 p = table.Vector(i, "px", "py", moving ? "pz" : "");
    report->Norm("contact_point", contact.point, p, unit * (rolling.size + farthest));
    report->Norm("center_of_mass", sample.q.tail<3>() + arm, table.Vector(i, "gx", "gy", "gz"),
                 unit * (rolling.size + farthest));
    report->Norm("velocity", velocity, table.Vector(i, "vgx", "vgy", "vgz"), unit * (rate * rolling.size));
    const double force = rolling.weight + rolling.mass * rate * rate * rolling.size;
    report->Norm("force", contact.force, table.Vector(i, "Fx", "Fy", "Fz"), 10 * unit * force);
    if (moving) report->Norm("normal", contact.normal, table.Vector(i, "nx", "ny", "nz"), 8 * kEpsilon);
    const double energy = rolling.mass * rate * rate * rolling.size * rolling.size + rolling.weight * farthest;
    report->Number("kinetic_energy", sample.kinetic_energy, table.Number(i, "Ekin"), unit * energy);
    report->Number("potential_energy", sample.potential_energy, table.Number(i, "Epot"), unit * energy);
    if (!moving) {
      report->Number("energy", sample.kinetic_energy + sample.potential_energy, table.Number(i, "E"), unit * energy);
    }
  }
  return run;
}

}  // namespace rollgait::reference
