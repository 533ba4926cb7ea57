#include "tests/formats/opensim_reader.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace rollgait::client {
namespace {

using SimTK::Transform;
using SimTK::Vec3;
using Element = SimTK::Xml::Element;

std::string Name(const Element& element) { return element.getRequiredAttributeValue("name"); }

Vec3 Vector(Element element, const std::string& tag) { return element.getRequiredElementValueAs<Vec3>(tag); }

std::string Word(Element element, const std::string& tag) { return element.getRequiredElementValue(tag); }

std::vector<Element> Objects(Element model, const std::string& set, const std::string& type) {
  const SimTK::Array_<Element> all = model.getRequiredElement(set).getRequiredElement("objects").getAllElements(type);
  return {all.begin(), all.end()};
}

// "/bodyset/thigh_r" and "/ground": the last part of the path.
std::string LastPart(const std::string& path) { return path.substr(path.rfind('/') + 1); }

struct OffsetFrame {
  std::string parent;
  Transform place;
};

OffsetFrame FindFrame(Element joint, const std::string& socket) {
  const std::string name = Word(joint, socket);
  for (Element& frame : joint.getRequiredElement("frames").getAllElements("PhysicalOffsetFrame")) {
    if (Name(frame) != name) continue;
    SimTK::Rotation rotation;
    rotation.setRotationToBodyFixedXYZ(Vector(frame, "orientation"));
    return {LastPart(Word(frame, "socket_parent")), Transform(rotation, Vector(frame, "translation"))};
  }
  throw std::runtime_error(Name(joint) + " has no frame " + name);
}

}  // namespace

double MotTable::At(size_t row, const std::string& label) const {
  const auto at = std::find(labels.begin(), labels.end(), label);
  if (at == labels.end()) throw std::runtime_error("the table has no column " + label);
  return rows.at(row).at(at - labels.begin());
}

MotTable ReadMot(const std::string& text) {
  MotTable table;
  std::istringstream lines(text);
  std::string line, word;
  size_t rows = 0, columns = 0;
  while (std::getline(lines, line) && line != "endheader") {
    if (line.rfind("nRows=", 0) == 0) rows = std::stoul(line.substr(6));
    if (line.rfind("nColumns=", 0) == 0) columns = std::stoul(line.substr(9));
    if (line == "inDegrees=yes") table.in_degrees = true;
  }
  std::getline(lines, line);
  std::istringstream labels(line);
  while (std::getline(labels, word, '\t')) table.labels.push_back(word);
  while (std::getline(lines, line)) {
    std::istringstream values(line);
    std::vector<double> row;
    while (std::getline(values, word, '\t')) row.push_back(std::stod(word));
    if (row.size() != columns) throw std::runtime_error("a row has " + std::to_string(row.size()) + " values");
    table.rows.push_back(row);
  }
  if (table.labels.size() != columns || table.rows.size() != rows) throw std::runtime_error("not the size of the head");
  return table;
}

OsimModel::OsimModel(const std::string& xml) {
  SimTK::Xml::Document document;
  document.readFromString(xml);
  Element root = document.getRootElement();
  if (root.getElementTag() != "OpenSimDocument" || root.getRequiredAttributeValue("Version") != "40000") {
    throw std::runtime_error("not a document of OpenSim 4");
  }
  Element model = root.getRequiredElement("Model");
  gravity_ = Vector(model, "gravity");
  for (Element& body : Objects(model, "BodySet", "Body")) {
    const SimTK::Vec6 i = body.getRequiredElementValueAs<SimTK::Vec6>("inertia");
    const double mass = body.getRequiredElementValueAs<double>("mass");
    const Vec3 center = Vector(body, "mass_center");
    // OpenSim's inertia is about the mass centre; Simbody's is about the origin.
    const SimTK::Inertia central(i[0], i[1], i[2], i[3], i[4], i[5]);
    masses_.emplace(Name(body), SimTK::MassProperties(mass, center, central.shiftFromMassCenter(center, mass)));
  }
  bodies_["ground"] = matter_.Ground().getMobilizedBodyIndex();
  for (Element& joint : Objects(model, "JointSet", "CustomJoint")) AddJoint(joint);
  SimTK::Force::UniformGravity(forces_, matter_, gravity_);
  for (Element& marker : Objects(model, "MarkerSet", "Marker")) {
    markers_[Name(marker)] = {LastPart(Word(marker, "socket_parent_frame")), Vector(marker, "location")};
  }
  for (Element& actuator : Objects(model, "ForceSet", "CoordinateActuator")) {
    if (actuator.getRequiredElementValueAs<double>("optimal_force") != 1) throw std::runtime_error("optimal_force");
    actuators_[Word(actuator, "coordinate")] = {actuator.getRequiredElementValueAs<double>("min_control"),
                                                actuator.getRequiredElementValueAs<double>("max_control")};
  }
  state_ = system_.realizeTopology();
  system_.realizeModel(state_);
  acceleration_.resize(state_.getNU());
  acceleration_ = 0;
  ClearForces();
}

void OsimModel::AddJoint(Element joint) {
  const OffsetFrame parent = FindFrame(joint, "socket_parent_frame");
  const OffsetFrame child = FindFrame(joint, "socket_child_frame");
  std::vector<std::string> names;
  for (Element& coordinate : joint.getRequiredElement("coordinates").getAllElements("Coordinate")) {
    names.push_back(Name(coordinate));
  }
  Element transform = joint.getRequiredElement("SpatialTransform");
  SimTK::Array_<const SimTK::Function*> functions;
  SimTK::Array_<SimTK::Array_<int>> inputs;
  SimTK::Array_<Vec3> axes;
  size_t k = 0;
  static const char* const kOrder[] = {"rotation1",    "rotation2",    "rotation3",
                                       "translation1", "translation2", "translation3"};
  for (Element& axis : transform.getAllElements("TransformAxis")) {
    if (k >= 6 || Name(axis) != kOrder[k]) throw std::runtime_error(Name(joint) + ": axes out of order");
    ++k;
    axes.push_back(Vector(axis, "axis"));
    const std::string coordinate = axis.getRequiredElement("coordinates").getValue();
    if (coordinate.empty()) {
      const double value = axis.getRequiredElement("Constant").getRequiredElementValueAs<double>("value");
      functions.push_back(new SimTK::Function::Constant(value, 0));
      inputs.push_back({});
      continue;
    }
    const auto at = std::find(names.begin(), names.end(), coordinate);
    if (at == names.end()) throw std::runtime_error(Name(joint) + " has no coordinate " + coordinate);
    const SimTK::Vec2 line =
        axis.getRequiredElement("LinearFunction").getRequiredElementValueAs<SimTK::Vec2>("coefficients");
    functions.push_back(new SimTK::Function::Linear(SimTK::Vector(line)));
    inputs.push_back(SimTK::Array_<int>(1, static_cast<int>(at - names.begin())));
  }
  if (k != 6) throw std::runtime_error(Name(joint) + " has not six axes");
  SimTK::MobilizedBody& carrier = matter_.updMobilizedBody(bodies_.at(parent.parent));
  const SimTK::MobilizedBody::FunctionBased body(carrier, parent.place, SimTK::Body::Rigid(masses_.at(child.parent)),
                                                 child.place, static_cast<int>(names.size()), functions, inputs, axes);
  bodies_[child.parent] = body.getMobilizedBodyIndex();
  for (size_t i = 0; i < names.size(); ++i)
    coordinates_[names[i]] = {body.getMobilizedBodyIndex(), static_cast<int>(i)};
}

const SimTK::MobilizedBody& OsimModel::Body(const std::string& name) const {
  return matter_.getMobilizedBody(bodies_.at(name));
}

void OsimModel::Set(const std::string& coordinate, double value, double speed, double acceleration) {
  const auto [index, place] = coordinates_.at(coordinate);
  const SimTK::MobilizedBody& body = matter_.getMobilizedBody(index);
  body.setOneQ(state_, place, value);
  body.setOneU(state_, place, speed);
  body.updOneFromUPartition(state_, place, acceleration_) = acceleration;
}

void OsimModel::Realize() { system_.realize(state_, SimTK::Stage::Dynamics); }

SimTK::Vec3 OsimModel::MarkerPosition(const std::string& name) const {
  const Marker& marker = markers_.at(name);
  return Pose(marker.body) * marker.location;
}

void OsimModel::ClearForces() {
  body_forces_.resize(matter_.getNumBodies());
  body_forces_ = SimTK::SpatialVec(Vec3(0), Vec3(0));
}

void OsimModel::AddForce(const std::string& body, const Vec3& force, const Vec3& point, const Vec3& couple) {
  const Vec3 arm = point - Pose(body).p();
  body_forces_[bodies_.at(body)] += SimTK::SpatialVec(couple + arm % force, force);
}

std::map<std::string, double> OsimModel::InverseDynamics() const {
  SimTK::Vector_<SimTK::SpatialVec> forces = system_.getRigidBodyForces(state_, SimTK::Stage::Dynamics);
  forces += body_forces_;
  SimTK::Vector residual;
  matter_.calcResidualForceIgnoringConstraints(state_, SimTK::Vector(state_.getNU(), 0.0), forces, acceleration_,
                                               residual);
  std::map<std::string, double> torques;
  for (const auto& [name, place] : coordinates_) {
    torques[name] = matter_.getMobilizedBody(place.first).getOneFromUPartition(state_, place.second, residual);
  }
  return torques;
}

}  // namespace rollgait::client
