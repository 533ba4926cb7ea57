#include "client/import/osim_values.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace rollgait::client {
namespace {

constexpr size_t kMostKnots = 1000;

double OnLine(const std::vector<double>& x, const std::vector<double>& y, double position) {
  if (position <= x.front()) return y.front();
  for (size_t k = 1; k < x.size(); ++k) {
    if (position > x[k]) continue;
    return y[k - 1] + (y[k] - y[k - 1]) * (position - x[k - 1]) / (x[k] - x[k - 1]);
  }
  return y.back();
}

OsimFunction ReadFunction(const OsimElement& function, double position) {
  const std::string kind = function.Kind();
  OsimFunction result;
  if (kind == "Constant") {
    result.is_constant = true;
    result.value = function.Number("value", 0);
  } else if (kind == "LinearFunction") {
    const std::vector<double> coefficients = function.Numbers("coefficients", 2, 2);
    if (coefficients.empty()) function.Refuse("needs two coefficients");
    result = {coefficients[0] == 0, true, coefficients[0], coefficients[1],
              coefficients[0] * position + coefficients[1]};
  } else if (kind == "PolynomialFunction") {
    for (const double c : function.Numbers("coefficients", 1, 20)) result.value = result.value * position + c;
  } else if (kind == "MultiplierFunction") {
    const double scale = function.Number("scale", 1);
    result = ReadOsimFunction(function, position);
    result = {result.is_constant, result.is_line, scale * result.slope, scale * result.offset, scale * result.value};
  } else if (kind == "SimmSpline" || kind == "NaturalCubicSpline" || kind == "PiecewiseLinearFunction" ||
             kind == "GCVSpline") {
    const std::vector<double> x = function.Numbers("x", 1, kMostKnots), y = function.Numbers("y", 1, kMostKnots);
    if (x.empty() || x.size() != y.size()) function.Refuse("needs as many numbers in x as in y");
    if (std::adjacent_find(x.begin(), x.end(), [](double a, double b) { return !(a < b); }) != x.end()) {
      function.Refuse("its x must increase");
    }
    result.value = OnLine(x, y, position);
  } else {
    function.Refuse(
        "is a function that is not read; must be Constant, LinearFunction, PolynomialFunction, "
        "MultiplierFunction or a spline");
  }
  return result;
}

}  // namespace

Eigen::Vector3d FromOpensim(const Eigen::Vector3d& v) { return {v.x(), 0.0 - v.z(), v.y()}; }

Eigen::Matrix3d FromOpensim(const Eigen::Matrix3d& matrix) {
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return axes * matrix * axes.transpose();
}

std::string OsimElement::Kind() const { return element_->Name(); }

std::string OsimElement::Text(const char* child) const {
  const tinyxml2::XMLElement* const found = source_->Only(*element_, child, false);
  const char* const text = found == nullptr ? nullptr : found->GetText();
  if (text == nullptr) return "";
  std::string trimmed = text;
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  trimmed.erase(std::find_if_not(trimmed.rbegin(), trimmed.rend(), is_space).base(), trimmed.end());
  trimmed.erase(trimmed.begin(), std::find_if_not(trimmed.begin(), trimmed.end(), is_space));
  return trimmed;
}

std::vector<std::string> OsimElement::Words(const char* child) const {
  std::istringstream text(Text(child));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

std::vector<double> OsimElement::Numbers(const char* child, size_t least, size_t most) const {
  const std::string text = Text(child);
  if (text.empty()) return {};
  return source_->Numbers(*element_, std::string("<") + child + ">", text.c_str(), least, most).values;
}

double OsimElement::Number(const char* child, double otherwise) const {
  const std::vector<double> values = Numbers(child, 1, 1);
  return values.empty() ? otherwise : values[0];
}

Eigen::Vector3d OsimElement::Vector(const char* child, const Eigen::Vector3d& otherwise) const {
  const std::vector<double> values = Numbers(child, 3, 3);
  return values.empty() ? otherwise : Eigen::Vector3d(values[0], values[1], values[2]);
}

bool OsimElement::Flag(const char* child, bool otherwise) const {
  const std::string text = Text(child);
  return text.empty() ? otherwise : source_->Flag(*element_, std::string("<") + child + ">", text.c_str());
}

Pose OsimElement::Place() const {
  const Eigen::Vector3d angles = Vector("orientation", Eigen::Vector3d::Zero());
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (const int axis : {0, 1, 2}) {
    if (angles(axis) == 0) continue;
    rotation = rotation * Eigen::AngleAxisd(angles(axis), Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  }
  return {FromOpensim(rotation), FromOpensim(Vector("translation", Eigen::Vector3d::Zero()))};
}

std::vector<OsimElement> OsimElement::Children() const {
  std::vector<OsimElement> children;
  for (const auto* child = element_->FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    children.emplace_back(source_, child);
  }
  return children;
}

std::vector<OsimElement> OsimElement::Objects(const char* child) const {
  const tinyxml2::XMLElement* found = source_->Only(*element_, child, false);
  if (found == nullptr) return {};
  if (const auto* const objects = source_->Only(*found, "objects", false)) found = objects;
  return OsimElement(source_, found).Children();
}

OsimFunction ReadOsimFunction(const OsimElement& owner, double position) {
  for (const OsimElement& child : owner.Children()) {
    const std::string kind = child.Kind();
    if (kind == "coordinates" || kind == "axis" || kind == "scale") continue;
    // Some versions put it into an element of its own.
    if (kind == "function") return ReadOsimFunction(child, position);
    return ReadFunction(child, position);
  }
  return {.is_constant = true};
}

}  // namespace rollgait::client
