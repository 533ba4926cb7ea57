#include "client/import/osim_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollgait::client {
namespace {

// "inf" and its relatives, as OpenSim writes them; else a number.
double Control(const OsimElement& force, const char* child, double unlimited) {
  std::string word = force.Text(child);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word.empty() || word == "inf" || word == "infinity" || word == "-inf" || word == "-infinity") return unlimited;
  return force.Number(child, unlimited);
}

bool AddActuator(const OsimElement& force, TreeJoint* joint) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  double least = Control(force, "min_control", -kUnlimited), most = Control(force, "max_control", kUnlimited);
  const bool unlimited = std::isinf(least) || std::isinf(most);
  if (std::isinf(least)) least = -1;
  if (std::isinf(most)) most = 1;
  if (!(least < most)) force.Refuse("min_control must be below max_control");
  const double optimal = force.Number("optimal_force", 1);
  const double ends[] = {optimal * least, optimal * most};
  joint->effort_min += std::min({ends[0], ends[1], 0.0});
  joint->effort_max += std::max({ends[0], ends[1], 0.0});
  return unlimited;
}

void AddSpring(const OsimElement& force, TreeJoint* joint) {
  const double stiffness = force.Number("stiffness", 0), rest = force.Number("rest_length", 0);
  if (stiffness < 0) force.Refuse("its stiffness is negative");
  const double sum = joint->stiffness + stiffness;
  if (sum > 0) joint->rest = (joint->stiffness * joint->rest + stiffness * rest) / sum;
  joint->stiffness = sum;
  joint->damping += force.Number("viscosity", 0);
}

}  // namespace

bool AddOsimForce(const OsimElement& force, const std::set<std::string>& base, LinkTree* tree, LeftOut* left_out) {
  const std::string kind = force.Kind();
  const bool drives = kind == "CoordinateActuator" || kind == "ActivationCoordinateActuator";
  if (!drives && kind != "SpringGeneralizedForce") {
    left_out->Add(force.xml(),
                  "a model has efforts, springs and dampers of joints only; give effortMin and effortMax of "
                  "what it drives in the side file");
    return false;
  }
  std::string coordinate = force.Text("coordinate");
  if (coordinate.empty()) {  // as later versions write it
    coordinate = force.Text("socket_coordinate");
    coordinate.erase(0, coordinate.rfind('/') + 1);
  }
  if (base.count(coordinate) != 0) {
    left_out->Add(force.xml(), "it acts on the base, which floats");
    return false;
  }
  if (!force.Flag("appliesForce", true)) {
    left_out->Add(force.xml(), "it is switched off");
    return false;
  }
  const int index = tree->FindJoint(coordinate);
  if (index < 0) {
    left_out->Add(force.xml(), "it acts on a coordinate that moves no joint of the model");
    return false;
  }
  TreeJoint* const joint = &tree->joints[static_cast<size_t>(index)];
  if (drives) return AddActuator(force, joint);
  AddSpring(force, joint);
  return false;
}

}  // namespace rollgait::client
