#include "tests/reference_check/reader.h"

#include <Eigen/Geometry>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace rollgait::reference {
namespace {

RealVectorX ToVector(const Json& value, const std::string& where) {
  if (!value.is_array()) throw ReadError(where + " is not a list of numbers");
  RealVectorX vector(value.size());
  for (size_t i = 0; i < value.size(); ++i) {
    vector(static_cast<int>(i)) = ToReal(value[i], where + "[" + std::to_string(i) + "]");
  }
  return vector;
}

}  // namespace

Document ReadDocument(const std::string& path) {
  std::ifstream file(path);
  if (!file.good()) throw ReadError(path + " cannot be opened");
  Document document{path, nullptr};
  if (path.size() < 5 || path.substr(path.size() - 5) != ".json") return document;
  try {
    document.json = Json::parse(file);
  } catch (const Json::exception& error) {
    throw ReadError(path + " is not JSON: " + error.what());
  }
  if (!document.json.is_structured()) throw ReadError(path + " holds neither a JSON object nor a list");
  return document;
}

Real ParseReal(const std::string& text, const std::string& where) {
  char* end = nullptr;
  const Real number = std::strtold(text.c_str(), &end);
  const bool starts = !text.empty() && !std::isspace(static_cast<unsigned char>(text[0]));
  if (!starts || end != text.c_str() + text.size() || !std::isfinite(number)) {
    throw ReadError(where + " holds '" + text + "', which is not a finite decimal number");
  }
  return number;
}

Real ToReal(const Json& value, const std::string& where) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return ParseReal(value.get<std::string>(), where);
  throw ReadError(where + " is neither a number nor a string that holds one");
}

Fields::Fields(const Json& object, std::string where) : object_(&object), where_(std::move(where)) {
  if (!object.is_object()) throw ReadError(where_ + " is not an object");
}

bool Fields::Has(const std::string& name) const { return object_->contains(name); }

const Json& Fields::Get(const std::string& name) {
  const auto found = object_->find(name);
  if (found == object_->end()) throw ReadError(where_ + " lacks the field '" + name + "'");
  asked_.insert(name);
  return *found;
}

Fields Fields::Object(const std::string& name) { return {Get(name), where_ + "." + name}; }

Real Fields::Number(const std::string& name) { return ToReal(Get(name), where_ + "." + name); }

bool Fields::Bool(const std::string& name) {
  const Json& value = Get(name);
  if (!value.is_boolean()) throw ReadError(where_ + "." + name + " is neither true nor false");
  return value.get<bool>();
}

std::string Fields::Text(const std::string& name) {
  const Json& value = Get(name);
  if (!value.is_string()) throw ReadError(where_ + "." + name + " is not a text");
  return value.get<std::string>();
}

RealVectorX Fields::Vector(const std::string& name) { return ToVector(Get(name), where_ + "." + name); }

RealVector3 Fields::Vector3(const std::string& name) {
  const RealVectorX vector = Vector(name);
  if (vector.size() != 3) throw ReadError(where_ + "." + name + " does not have 3 entries");
  return vector;
}

RealMatrixX Fields::Matrix(const std::string& name) {
  const Json& rows = Get(name);
  const std::string where = where_ + "." + name;
  if (!rows.is_array() || rows.empty()) throw ReadError(where + " is not a list of rows");
  RealMatrixX matrix;
  for (size_t i = 0; i < rows.size(); ++i) {
    const RealVectorX row = ToVector(rows[i], where + "[" + std::to_string(i) + "]");
    if (i == 0) matrix.resize(rows.size(), row.size());
    if (row.size() != matrix.cols()) throw ReadError(where + " has rows of different length");
    matrix.row(static_cast<int>(i)) = row.transpose();
  }
  return matrix;
}

RealMatrix3 Fields::Matrix3(const std::string& name) {
  const RealMatrixX matrix = Matrix(name);
  if (matrix.rows() != 3 || matrix.cols() != 3) throw ReadError(where_ + "." + name + " is not 3 × 3");
  return matrix;
}

RealMatrix3 Fields::Rotation(const std::string& name) {
  const RealVectorX q = Vector(name);
  if (q.size() != 4 || !(q.norm() > 0)) throw ReadError(where_ + "." + name + " is not a quaternion (w, x, y, z)");
  return Eigen::Quaternion<Real>(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
}

std::vector<Fields> Fields::List(const std::string& name) {
  const Json& items = Get(name);
  const std::string where = where_ + "." + name;
  if (!items.is_array() || items.empty()) throw ReadError(where + " is not a list with at least one object");
  std::vector<Fields> list;
  for (size_t i = 0; i < items.size(); ++i) list.emplace_back(items[i], where + "[" + std::to_string(i) + "]");
  return list;
}

void Fields::Skip(const std::string& name) { Get(name); }

void Fields::Finish() const {
  for (const auto& [name, value] : object_->items()) {
    if (asked_.count(name) == 0) throw ReadError(where_ + " holds the field '" + name + "', which is not known here");
  }
}

}  // namespace rollgait::reference
