#include "client/import/mjcf_values.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "client/rotation_of_z.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kMostWithin = 16;  // classes within each other
constexpr size_t kMostClasses = 200;
// Elements of which a reader asks for defaults.
constexpr const char* kWithDefaults[] = {"geom",     "joint",    "general",     "motor",
                                         "position", "velocity", "intvelocity", "damper"};

Eigen::Vector3d Direction(const MjcfElement& element, const Eigen::Vector3d& v) {
  if (!(v.norm() > 1e-9)) element.Refuse("a direction of its orientation has length 0");
  return v.normalized();
}

}  // namespace

void MjcfCompiler::Read(const XmlSource& source, const tinyxml2::XMLElement& compiler) {
  const MjcfElement element(&source, this, &compiler, nullptr);
  const auto word = [&](const char* attribute, const std::string& otherwise) {
    const char* const text = element.Get(attribute);
    return text == nullptr ? otherwise : std::string(text);
  };
  const auto refuse = [&](const char* attribute, const char* must) {
    source.Refuse(compiler,
                  std::string(attribute) + " is \"" + word(attribute, "").substr(0, 40) + "\"; must be " + must);
  };
  const std::string angle = word("angle", degrees ? "degree" : "radian");
  if (angle != "degree" && angle != "radian") refuse("angle", "degree or radian");
  degrees = angle == "degree";
  if (word("coordinate", "local") != "local") refuse("coordinate", "local: MuJoCo has no other since version 2.3.4");
  euler_sequence = word("eulerseq", euler_sequence);
  const bool axes = std::all_of(euler_sequence.begin(), euler_sequence.end(),
                                [](char c) { return std::strchr("xyzXYZ", c) != nullptr; });
  if (euler_sequence.size() != 3 || !axes) refuse("eulerseq", "three of x, y, z, X, Y and Z");
  if (element.Has("inertiafromgeom")) {
    const std::string from = word("inertiafromgeom", "");
    if (from != "auto" && from != "true" && from != "false") refuse("inertiafromgeom", "auto, true or false");
    inertia_from_geoms = from == "auto"   ? FromGeoms::kWithoutInertial
                         : from == "true" ? FromGeoms::kAlways
                                          : FromGeoms::kNever;
  }
  const auto flag = [&](const char* attribute, bool* value) {
    if (element.Has(attribute)) *value = source.Flag(compiler, attribute, element.Get(attribute));
  };
  flag("autolimits", &autolimits);
  flag("balanceinertia", &balance_inertia);
  bound_mass = element.Number("boundmass", bound_mass);
  bound_inertia = element.Number("boundinertia", bound_inertia);
  total_mass = element.Number("settotalmass", total_mass);
  const std::vector<double> groups = element.Numbers("inertiagrouprange", 2, 2);
  if (!groups.empty()) {
    first_group = groups[0];
    last_group = groups[1];
  }
}

double MjcfCompiler::Angle(double value) const { return degrees ? value * kPi / 180 : value; }

void MjcfDefaults::Add(const XmlSource& source, const tinyxml2::XMLElement& element, const std::string& parent,
                       int depth) {
  if (depth > kMostWithin) source.Refuse(element, "is within more than 16 other classes");
  const char* const given = element.Attribute("class");
  if (given == nullptr && !parent.empty()) source.Refuse(element, "needs the attribute class");
  std::string name = given == nullptr ? "main" : source.Name(element, "class");
  if (parent.empty() && name != "main") {  // a name of its own for what holds for all
    classes_.emplace(name, Class{"main", {}});
    name = "main";
  }
  const auto [entry, is_new] = classes_.emplace(name, Class{parent, {}});
  if (classes_.size() > kMostClasses) source.Refuse(element, "is one of more than 200 classes");
  if (!is_new && entry->second.parent != parent) source.Refuse(element, "the class \"" + name + "\" stands twice");
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    if (std::strcmp(child->Name(), "default") == 0) {
      Add(source, *child, name, depth + 1);
      continue;
    }
    const auto is = [&](const char* kind) { return std::strcmp(child->Name(), kind) == 0; };
    if (std::none_of(std::begin(kWithDefaults), std::end(kWithDefaults), is)) continue;
    for (const tinyxml2::XMLElement* const other : entry->second.elements) {
      if (is(other->Name())) source.Refuse(*child, "stands twice in its class; give each attribute once");
    }
    entry->second.elements.push_back(child);
  }
}

const MjcfInherited& MjcfDefaults::Find(const XmlSource& source, const tinyxml2::XMLElement& user,
                                        const std::string& name, const char* kind) {
  if (!name.empty() && name != "main" && classes_.count(name) == 0) {
    source.Refuse(user, "is of the class \"" + name.substr(0, 64) + "\", which <default> does not have");
  }
  const auto [entry, is_new] = found_.emplace(std::pair(name.empty() ? "main" : name, kind), MjcfInherited());
  MjcfInherited& inherited = entry->second;
  if (!is_new) return inherited;
  const bool actuator = std::strcmp(kind, "motor") == 0;
  auto at = classes_.find(entry->first.first);
  while (at != classes_.end()) {
    // The last one of a class wins.
    for (auto element = at->second.elements.rbegin(); element != at->second.elements.rend(); ++element) {
      const std::string other = (*element)->Name();
      const bool is_of_kind = actuator ? other != "geom" && other != "joint" : other == kind;
      if (is_of_kind) inherited.elements.push_back(*element);
    }
    at = at->second.parent.empty() ? classes_.end() : classes_.find(at->second.parent);
  }
  for (const tinyxml2::XMLElement* const element : inherited.elements) {
    for (const auto* attribute = element->FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
      inherited.values.emplace(attribute->Name(), attribute->Value());
    }
  }
  return inherited;
}

const char* MjcfElement::Get(const char* attribute) const {
  if (const char* const own = element_->Attribute(attribute)) return own;
  if (inherited_ == nullptr) return nullptr;
  const auto found = inherited_->values.find(attribute);
  return found == inherited_->values.end() ? nullptr : found->second;
}

double MjcfElement::Number(const char* attribute, double otherwise) const {
  const char* const text = Get(attribute);
  return text == nullptr ? otherwise : source_->Number(*element_, attribute, text);
}

Eigen::Vector3d MjcfElement::Vector(const char* attribute, const Eigen::Vector3d& otherwise) const {
  const char* const text = Get(attribute);
  return text == nullptr ? otherwise : source_->Vector(*element_, attribute, text);
}

std::vector<double> MjcfElement::Numbers(const char* attribute, size_t least, size_t most) const {
  const char* const text = Get(attribute);
  return text == nullptr ? std::vector<double>() : source_->Numbers(*element_, attribute, text, least, most).values;
}

std::vector<double> MjcfElement::Overlaid(const char* attribute, size_t most) const {
  std::vector<const tinyxml2::XMLElement*> from = {element_};
  if (inherited_ != nullptr) from.insert(from.end(), inherited_->elements.begin(), inherited_->elements.end());
  std::vector<double> values;
  for (const tinyxml2::XMLElement* const element : from) {
    const char* const text = element->Attribute(attribute);
    if (text == nullptr || values.size() == most) continue;
    const std::vector<double> own = source_->Numbers(*element_, attribute, text, 1, most).values;
    for (size_t k = values.size(); k < own.size(); ++k) values.push_back(own[k]);
  }
  return values;
}

bool MjcfElement::IsLimited(const char* limited, const char* range) const {
  const char* const word = Get(limited);
  if (word == nullptr || std::strcmp(word, "auto") == 0) return compiler_->autolimits && Has(range);
  return source_->Flag(*element_, limited, word);
}

Eigen::Matrix3d TurnOfZ(const MjcfElement& element, const Eigen::Vector3d& direction) {
  return RotationOfZTo(Direction(element, direction));
}

Eigen::Matrix3d MjcfElement::Euler(const std::vector<double>& angles) const {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (size_t k = 0; k < 3; ++k) {
    const char letter = compiler_->euler_sequence[k];
    const int axis = std::tolower(static_cast<unsigned char>(letter)) - 'x';
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(compiler_->Angle(angles[k]), Eigen::Vector3d::Unit(axis)).toRotationMatrix();
    // Lower case: about the axes as they have been turned; upper case: about those of the parent.
    rotation = std::islower(static_cast<unsigned char>(letter)) != 0 ? Eigen::Matrix3d(rotation * turn)
                                                                     : Eigen::Matrix3d(turn * rotation);
  }
  return rotation;
}

Eigen::Matrix3d MjcfElement::Orientation() const {
  const std::vector<double> turn = Numbers("axisangle", 4, 4), axes = Numbers("xyaxes", 6, 6),
                            z = Numbers("zaxis", 3, 3), euler = Numbers("euler", 3, 3), quat = Numbers("quat", 4, 4);
  const int given = !turn.empty() + !axes.empty() + !z.empty() + !euler.empty();
  if (given > 1) Refuse("has several orientations; give one of quat, axisangle, xyaxes, zaxis and euler");
  if (!turn.empty()) {
    const Eigen::Vector3d axis = Direction(*this, {turn[0], turn[1], turn[2]});
    return Eigen::AngleAxisd(compiler_->Angle(turn[3]), axis).toRotationMatrix();
  }
  if (!axes.empty()) {
    const Eigen::Vector3d x = Direction(*this, {axes[0], axes[1], axes[2]}), given_y(axes[3], axes[4], axes[5]);
    const Eigen::Vector3d y = Direction(*this, given_y - x.dot(given_y) * x);
    Eigen::Matrix3d rotation;
    rotation << x, y, x.cross(y);
    return rotation;
  }
  if (!z.empty()) return TurnOfZ(*this, {z[0], z[1], z[2]});
  if (!euler.empty()) return Euler(euler);
  if (quat.empty() || (quat[0] == 1 && quat[1] == 0 && quat[2] == 0 && quat[3] == 0)) {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::Quaterniond q(quat[0], quat[1], quat[2], quat[3]);
  if (!(q.norm() > 1e-9)) Refuse("quat has length 0; give a rotation");
  return q.normalized().toRotationMatrix();
}

}  // namespace rollgait::client
