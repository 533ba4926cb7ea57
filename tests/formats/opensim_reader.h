// OpenSim's files, read as its documentation says and by no code of the service: XML by Simbody's own parser, the
// bodies and joints as the Simbody mobilizers that OpenSim makes of them.
#ifndef ROLLGAIT_TESTS_FORMATS_OPENSIM_READER_H_
#define ROLLGAIT_TESTS_FORMATS_OPENSIM_READER_H_

#include <Simbody.h>

#include <map>
#include <string>
#include <vector>

namespace rollgait::client {

// The table of a .mot file: header lines, "endheader", labels, rows.
struct MotTable {
  bool in_degrees = false;
  std::vector<std::string> labels;
  std::vector<std::vector<double>> rows;

  double At(size_t row, const std::string& label) const;
};
MotTable ReadMot(const std::string& text);

class OsimModel {
 public:
  // Throws std::exception with Simbody's message for a file that does not have the elements, or refers to what it does
  // not have.
  explicit OsimModel(const std::string& xml);

  struct Marker {
    std::string body;
    SimTK::Vec3 location;
  };
  struct Actuator {
    double min_control, max_control;
  };
  const std::map<std::string, Marker>& markers() const { return markers_; }
  // By coordinate.
  const std::map<std::string, Actuator>& actuators() const { return actuators_; }
  int coordinates() const { return state_.getNQ(); }
  double TotalMass() const { return matter_.calcSystemMass(state_); }

  // Value, speed and acceleration of a coordinate, by its name.
  void Set(const std::string& coordinate, double value, double speed, double acceleration);
  // To be called after Set and before what follows.
  void Realize();

  const SimTK::MobilizedBody& Body(const std::string& name) const;
  SimTK::Transform Pose(const std::string& body) const { return Body(body).getBodyTransform(state_); }
  SimTK::Vec3 MarkerPosition(const std::string& name) const;

  void ClearForces();
  // On a body at a point of the ground's frame, with a couple.
  void AddForce(const std::string& body, const SimTK::Vec3& force, const SimTK::Vec3& point, const SimTK::Vec3& couple);
  // Generalised force that each coordinate needs besides gravity and the forces added.
  std::map<std::string, double> InverseDynamics() const;

 private:
  void AddJoint(SimTK::Xml::Element joint);

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  std::map<std::string, SimTK::MassProperties> masses_;
  std::map<std::string, SimTK::MobilizedBodyIndex> bodies_;
  std::map<std::string, std::pair<SimTK::MobilizedBodyIndex, int>> coordinates_;
  std::map<std::string, Marker> markers_;
  std::map<std::string, Actuator> actuators_;
  SimTK::Vec3 gravity_;
  SimTK::State state_;
  SimTK::Vector acceleration_;
  SimTK::Vector_<SimTK::SpatialVec> body_forces_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_FORMATS_OPENSIM_READER_H_
