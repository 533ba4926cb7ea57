#ifndef ROLLGAIT_TESTS_REFERENCE_CHECK_READER_H_
#define ROLLGAIT_TESTS_REFERENCE_CHECK_READER_H_

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/types.h"

namespace rollgait::reference {

using Json = nlohmann::json;
// Reference values keep more digits than double: an expectation that is rounded to double would already use up a
// tolerance of a few units in the last place.
using Real = long double;
using RealVector3 = Eigen::Matrix<Real, 3, 1>;
using RealMatrix3 = Eigen::Matrix<Real, 3, 3>;
using RealVectorX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrixX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// A file that cannot be read, or that holds a field this program does not know. The program ends with status 2.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One file. `json` is null for a CSV file, whose family reads it from `path`.
struct Document {
  std::string path;
  Json json;
};

// Reads and parses a .json file; takes any other name as it is if the file can be opened. Throws ReadError.
Document ReadDocument(const std::string& path);

// A JSON number, or a string that holds one decimal number and nothing else, correctly rounded. Throws ReadError;
// `where` names the field in the message.
Real ToReal(const Json& value, const std::string& where);
// The same for one text, such as a CSV cell.
Real ParseReal(const std::string& text, const std::string& where);

// The fields of one JSON object. Each is asked for by name; Finish() throws if one was never asked for. All members
// throw ReadError that names the field when it is missing or not of the shape asked for.
class Fields {
 public:
  Fields(const Json& object, std::string where);

  const std::string& where() const { return where_; }
  bool Has(const std::string& name) const;
  const Json& Get(const std::string& name);
  Fields Object(const std::string& name);
  Real Number(const std::string& name);
  double Double(const std::string& name) { return static_cast<double>(Number(name)); }
  bool Bool(const std::string& name);
  std::string Text(const std::string& name);
  RealVectorX Vector(const std::string& name);
  RealVector3 Vector3(const std::string& name);
  RealMatrixX Matrix(const std::string& name);  // rows of equal length
  RealMatrix3 Matrix3(const std::string& name);
  // Quaternion (w, x, y, z), normalised, as a rotation.
  RealMatrix3 Rotation(const std::string& name);
  // Objects of a list.
  std::vector<Fields> List(const std::string& name);
  // Marks a field as known without looking at it (comments, counts of digits).
  void Skip(const std::string& name);

  void Finish() const;

 private:
  const Json* object_;
  std::string where_;
  std::set<std::string> asked_;
};

}  // namespace rollgait::reference

#endif  // ROLLGAIT_TESTS_REFERENCE_CHECK_READER_H_
