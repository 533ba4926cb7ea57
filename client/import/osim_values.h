// Values of .osim elements: what stands between their tags, in the service's axes.
#ifndef ROLLGAIT_CLIENT_IMPORT_OSIM_VALUES_H_
#define ROLLGAIT_CLIENT_IMPORT_OSIM_VALUES_H_

#include <string>
#include <vector>

#include "client/import/xml_source.h"
#include "client/report/kinematics.h"

namespace rollgait::client {

// OpenSim's X forward, Y up, Z right as the service's x forward, y left, z up.
Eigen::Vector3d FromOpensim(const Eigen::Vector3d& v);
Eigen::Matrix3d FromOpensim(const Eigen::Matrix3d& matrix);

// Children of an element by name. Each throws Failure(kUsage) for a value that is none of its kind; `otherwise` is for
// a child that is not there or empty.
class OsimElement {
 public:
  OsimElement(const XmlSource* source, const tinyxml2::XMLElement* element) : source_(source), element_(element) {}

  const tinyxml2::XMLElement& xml() const { return *element_; }
  const XmlSource& source() const { return *source_; }
  std::string Kind() const;
  std::string Name() const { return source_->Name(*element_); }
  [[noreturn]] void Refuse(const std::string& reason) const { source_->Refuse(*element_, reason); }

  // The text of a child without spaces around it; empty if it has none.
  std::string Text(const char* child) const;
  // The words of it: a list of names.
  std::vector<std::string> Words(const char* child) const;
  double Number(const char* child, double otherwise) const;
  std::vector<double> Numbers(const char* child, size_t least, size_t most) const;    // empty: not there
  Eigen::Vector3d Vector(const char* child, const Eigen::Vector3d& otherwise) const;  // in the file's axes
  bool Flag(const char* child, bool otherwise) const;
  // `translation` and `orientation` (body-fixed X, Y, Z), in the service's axes.
  Pose Place() const;
  // What <child> holds, or <child><objects>.
  std::vector<OsimElement> Objects(const char* child) const;
  std::vector<OsimElement> Children() const;

 private:
  const XmlSource* source_;
  const tinyxml2::XMLElement* element_;
};

// A function of one coordinate.
struct OsimFunction {
  bool is_constant = false;
  bool is_line = false;  // slope · q + offset
  double slope = 0, offset = 0;
  double value = 0;  // at the position asked for
};
// The function of an element that holds one, at `position`: Constant, LinearFunction, PolynomialFunction, splines
// (between their knots as a straight line) and multiples of them. Throws Failure(kUsage) for others.
OsimFunction ReadOsimFunction(const OsimElement& owner, double position);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_OSIM_VALUES_H_
