// Attributes of MJCF elements: from the element or its default class, in the compiler's units.
#ifndef ROLLGAIT_CLIENT_IMPORT_MJCF_VALUES_H_
#define ROLLGAIT_CLIENT_IMPORT_MJCF_VALUES_H_

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/import/xml_source.h"
#include "client/report/kinematics.h"

namespace rollgait::client {

// <compiler>, as far as bodies depend on it.
struct MjcfCompiler {
  enum class FromGeoms { kNever, kAlways, kWithoutInertial };
  bool degrees = true;
  bool autolimits = true;  // MuJoCo before 3 refuses files in which this makes a difference
  std::string euler_sequence = "xyz";
  FromGeoms inertia_from_geoms = FromGeoms::kWithoutInertial;
  double first_group = 0, last_group = 5;  // of the geoms that count
  double bound_mass = 0, bound_inertia = 0;
  bool balance_inertia = false;
  double total_mass = -1;  // kg; not above 0: as it is

  // Throws Failure(kUsage) for values that it cannot have, and for coordinate="global".
  void Read(const XmlSource& source, const tinyxml2::XMLElement& compiler);
  double Angle(double value) const;  // rad
};

// What an element inherits from its class and the classes around that.
struct MjcfInherited {
  std::vector<const tinyxml2::XMLElement*> elements;  // nearest first
  std::map<std::string_view, const char*> values;     // of each attribute the nearest
};

// The tree of <default> classes.
class MjcfDefaults {
 public:
  // Adds a <default> of the top level, and those within it. Throws Failure(kUsage) for classes without name, names and
  // kinds of elements that stand twice, more than 200 classes and more than 16 within each other.
  void Add(const XmlSource& source, const tinyxml2::XMLElement& element) { Add(source, element, "", 0); }

  // What elements of a kind in the class `name` inherit; of any actuator for "motor", since these share their defaults.
  // Empty: the class "main". Throws Failure(kUsage) for a class that the file does not have; `user` is for the message.
  const MjcfInherited& Find(const XmlSource& source, const tinyxml2::XMLElement& user, const std::string& name,
                            const char* kind);

 private:
  struct Class {
    std::string parent;
    std::vector<const tinyxml2::XMLElement*> elements;
  };
  void Add(const XmlSource& source, const tinyxml2::XMLElement& element, const std::string& parent, int depth);

  std::map<std::string, Class> classes_;
  std::map<std::pair<std::string, std::string>, MjcfInherited> found_;  // by class and kind, once it has been asked for
};

// One element with its defaults.
class MjcfElement {
 public:
  // `inherited` may be null: nothing.
  MjcfElement(const XmlSource* source, const MjcfCompiler* compiler, const tinyxml2::XMLElement* element,
              const MjcfInherited* inherited)
      : source_(source), compiler_(compiler), element_(element), inherited_(inherited) {}

  const tinyxml2::XMLElement& xml() const { return *element_; }
  const XmlSource& source() const { return *source_; }
  const MjcfCompiler& compiler() const { return *compiler_; }

  // Null if neither the element nor its defaults have the attribute.
  const char* Get(const char* attribute) const;
  bool Has(const char* attribute) const { return Get(attribute) != nullptr; }
  double Number(const char* attribute, double otherwise) const;
  Eigen::Vector3d Vector(const char* attribute, const Eigen::Vector3d& otherwise) const;
  std::vector<double> Numbers(const char* attribute, size_t least, size_t most) const;  // empty: not there
  // Up to `most` numbers, each from the nearest element that has so many.
  std::vector<double> Overlaid(const char* attribute, size_t most) const;
  // Whether a range of the element holds: `limited` is true, or the range is given and it is not false.
  bool IsLimited(const char* limited, const char* range) const;
  // From quat, axisangle, xyaxes, zaxis or euler; nothing: the identity. Throws Failure(kUsage) for several of them
  // and for directions of length 0.
  Eigen::Matrix3d Orientation() const;
  Pose Place() const { return {Orientation(), Vector("pos", Eigen::Vector3d::Zero())}; }
  [[noreturn]] void Refuse(const std::string& reason) const { source_->Refuse(*element_, reason); }

 private:
  Eigen::Matrix3d Euler(const std::vector<double>& angles) const;

  const XmlSource* source_;
  const MjcfCompiler* compiler_;
  const tinyxml2::XMLElement* element_;
  const MjcfInherited* inherited_;
};

// The rotation that turns z into a direction by the shortest way. Throws like Orientation.
Eigen::Matrix3d TurnOfZ(const MjcfElement& element, const Eigen::Vector3d& direction);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MJCF_VALUES_H_
