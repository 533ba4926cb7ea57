#include "client/import/osim_joint.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "client/formats/osim.h"
#include "client/import/lumped_links.h"

namespace rollgait::client {
namespace {

struct Axis {
  bool turns;
  int direction;  // 0, 1, 2: X, Y, Z of OpenSim
};
struct JointKind {
  const char* name;
  std::vector<Axis> axes;  // of its coordinates, in their order
};
const std::vector<JointKind>& JointKinds() {
  static const std::vector<JointKind> kinds = {
      {"WeldJoint", {}},
      {"PinJoint", {{true, 2}}},
      {"SliderJoint", {{false, 0}}},
      {"UniversalJoint", {{true, 0}, {true, 1}}},
      {"GimbalJoint", {{true, 0}, {true, 1}, {true, 2}}},
      {"BallJoint", {{true, 0}, {true, 1}, {true, 2}}},
      {"PlanarJoint", {{true, 2}, {false, 0}, {false, 1}}},
      {"FreeJoint", {{true, 0}, {true, 1}, {true, 2}, {false, 0}, {false, 1}, {false, 2}}}};
  return kinds;
}

struct Coordinate {
  OsimElement element;
  std::string name;
  double start;  // rad or m
  bool locked;
  bool taken = false;  // a joint is made of it
};

// One axis of a joint, in the service's axes.
struct Step {
  bool turns;
  Eigen::Vector3d axis;
  int coordinate = -1;  // index; -1: held
  double zero = 0;      // of the coordinate
  double held = 0;      // rad or m
};

class MotionReader {
 public:
  MotionReader(const OsimElement& joint, LeftOut* left_out) : joint_(joint), left_out_(left_out) {}

  OsimMotion Read() {
    ReadCoordinates();
    if (joint_.Kind() == "CustomJoint") {
      ReadTransform();
    } else {
      ReadKind();
    }
    for (const Coordinate& coordinate : coordinates_) {
      if (coordinate.taken || coordinate.locked) continue;
      left_out_->Add(coordinate.element.xml(), "it moves nothing as itself: what it moves is held at its default");
    }
    return Chain();
  }

 private:
  void ReadCoordinates() {
    for (const OsimElement& element : joint_.Objects("coordinates")) {
      if (element.Kind() != "Coordinate") element.Refuse("must be a Coordinate");
      const bool locked = element.Flag("locked", false);
      if (locked) left_out_->Add(element.xml(), "it is locked in the file, at its default");
      if (element.Flag("prescribed", false)) left_out_->Add(element.xml(), "its motion is prescribed: it moves freely");
      coordinates_.push_back({element, element.Name(), element.Number("default_value", 0), locked});
    }
  }

  void ReadKind() {
    const auto kind = std::find_if(JointKinds().begin(), JointKinds().end(),
                                   [&](const JointKind& k) { return joint_.Kind() == k.name; });
    if (kind == JointKinds().end()) {
      std::string names;
      for (const JointKind& known : JointKinds()) names += std::string(known.name) + ", ";
      joint_.Refuse("is of a kind that is not read; must be " + names + "or CustomJoint");
    }
    if (coordinates_.size() != kind->axes.size()) {
      joint_.Refuse("has " + std::to_string(coordinates_.size()) + " coordinates, must have " +
                    std::to_string(kind->axes.size()));
    }
    for (size_t i = 0; i < kind->axes.size(); ++i) {
      const Eigen::Vector3d axis = FromOpensim(Eigen::Vector3d(Eigen::Vector3d::Unit(kind->axes[i].direction)));
      Coordinate& coordinate = coordinates_[i];
      Step step{kind->axes[i].turns, axis};
      if (coordinate.locked) {
        step.held = coordinate.start;
      } else {
        step.coordinate = static_cast<int>(i);
        coordinate.taken = true;
      }
      (step.turns ? turns_ : slides_).push_back(step);
    }
  }

  void ReadTransform() {
    const std::vector<OsimElement> axes = joint_.Objects("SpatialTransform");
    const auto by_name = [&](const std::string& name) {
      return std::find_if(axes.begin(), axes.end(), [&](const OsimElement& axis) {
        return axis.Kind() == "TransformAxis" && axis.Name() == name;
      });
    };
    // A coordinate that both turns and slides is an angle.
    for (const bool turns : {true, false}) {
      for (const int k : {0, 1, 2}) {
        const auto axis = by_name((turns ? "rotation" : "translation") + std::to_string(k + 1));
        if (axis != axes.end()) (turns ? turns_ : slides_).push_back(ReadAxis(*axis, turns, k));
      }
    }
  }

  Step ReadAxis(const OsimElement& axis, bool turns, int direction) {
    Step step{turns, FromOpensim(axis.Vector("axis", Eigen::Vector3d::Unit(direction)))};
    if (!(step.axis.norm() > 1e-6)) axis.Refuse("its axis has length 0; give a direction");
    step.axis.normalize();
    const std::vector<std::string> names = axis.Words("coordinates");
    if (names.size() > 1) axis.Refuse("moves with several coordinates, which is not read");
    if (names.empty()) {
      step.held = ReadOsimFunction(axis, 0).value;
      return step;
    }
    axis.source().RequireName(axis.xml(), "<coordinates>", names[0]);
    const auto found = std::find_if(coordinates_.begin(), coordinates_.end(),
                                    [&](const Coordinate& coordinate) { return coordinate.name == names[0]; });
    if (found == coordinates_.end()) {
      axis.Refuse("moves with \"" + names[0] + "\", which is no coordinate of its joint");
    }
    const OsimFunction function = ReadOsimFunction(axis, found->start);
    if (!found->locked && !found->taken && function.is_line && std::abs(function.slope) == 1) {
      found->taken = true;
      step.coordinate = static_cast<int>(found - coordinates_.begin());
      step.axis *= function.slope;
      step.zero = 0.0 - function.offset / function.slope;
      return step;
    }
    step.held = function.value;
    if (!found->locked && !function.is_constant) {
      left_out_->Add(axis.xml(),
                     "it moves by a function of a coordinate, which a model cannot express: held at its "
                     "value at the coordinate's default");
    }
    return step;
  }

  OsimMotion Chain() const {
    OsimMotion motion;
    Pose before = kNoMotion;  // what is held in front of the next joint
    for (const std::vector<Step>* const steps : {&slides_, &turns_}) {
      for (const Step& step : *steps) {
        if (step.coordinate >= 0) {
          motion.joints.push_back(JointOf(step, before));
          before = kNoMotion;
        } else if (step.turns) {
          before.rotation = before.rotation * Eigen::AngleAxisd(step.held, step.axis).toRotationMatrix();
        } else {
          before.position += before.rotation * (step.held * step.axis);
        }
      }
    }
    motion.end = before;
    return motion;
  }

  TreeJoint JointOf(const Step& step, const Pose& before) const {
    const Coordinate& coordinate = coordinates_[static_cast<size_t>(step.coordinate)];
    TreeJoint joint{.name = coordinate.name};
    joint.origin = before;
    joint.axis = step.axis;
    joint.zero = step.zero;
    constexpr double kFree = std::numeric_limits<double>::infinity();
    const std::vector<double> range = coordinate.element.Numbers("range", 2, 2);
    joint.lower = range.empty() || range[0] <= -kOsimUnlimited ? -kFree : range[0];
    joint.upper = range.empty() || range[1] >= kOsimUnlimited ? kFree : range[1];
    const bool unlimited = std::isinf(joint.lower) && std::isinf(joint.upper);
    joint.type = !step.turns ? TreeJoint::Type::kPrismatic
                 : unlimited ? TreeJoint::Type::kContinuous
                             : TreeJoint::Type::kRevolute;
    return joint;
  }

  const OsimElement joint_;
  LeftOut* const left_out_;
  std::vector<Coordinate> coordinates_;
  std::vector<Step> slides_, turns_;
};

}  // namespace

OsimMotion ReadOsimMotion(const OsimElement& joint, LeftOut* left_out) { return MotionReader(joint, left_out).Read(); }

}  // namespace rollgait::client
