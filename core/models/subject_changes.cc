#include "core/models/subject_changes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/base/check.h"
#include "core/base/field_path.h"
#include "core/base/nearest_word.h"
#include "core/models/human.h"
#include "core/models/rigid_body.h"
#include "core/models/sided_segment.h"

namespace rollgait {
namespace {

// A segment may be this much shorter or longer than the table has it.
constexpr double kShortest = 0.7, kLongest = 1.4;
// Semi-axes of a foot's surface, times the usual ones: length and breadth, and height. Wider ones would overlap those
// of the other foot in the standing body.
constexpr double kNarrowest = 0.5, kWidest = 1.5, kFlattest = 0.25, kHighest = 2;
constexpr size_t kMostLoads = 16;
constexpr double kHeaviest = 100;                   // kg
constexpr double kFurthest = 1;                     // m
constexpr double kStiffest = 1e5, kThickest = 1e4;  // N m/rad, N m s/rad

template <typename... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

// "thigh", "thigh_l" and "thigh_r": every name that FindSegment knows.
std::vector<std::string> AllSegmentNames() {
  std::vector<std::string> names = SegmentNames(false);
  for (const std::string& name : SegmentNames(true)) names.push_back(name);
  return names;
}

// "a, b, c".
std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// What is wrong with the segment of a load, which has to be on one side; empty if nothing is.
std::string SegmentProblem(const std::string& name) {
  const auto at = FindSegment(name);
  if (at && IsPaired(at->segment) && at->side == BodySide::kMidline) {
    return Text("\"", name, "\" is on both sides; choose ", name, "_l or ", name, "_r");
  }
  if (at) return "";
  const std::vector<std::string> known = SegmentNames(true);
  return Text("\"", name.substr(0, 40), "\" is no segment", DidYouMean(name.substr(0, 40), known), "; choose from ",
              Listed(known));
}

// "0.05, 0.05, 0.02".
std::string Numbers(const Vector3& v) { return Text(v.x(), ", ", v.y(), ", ", v.z()); }

bool IsWithin(double value, double min, double max) { return value >= min && value <= max; }  // false for NaN

// What is wrong with a load, if anything.
bool CheckLoad(const SegmentLoad& load, const std::string& path, Violations* violations) {
  const size_t before = violations->size();
  const std::string problem = SegmentProblem(load.segment);
  if (!problem.empty()) violations->push_back({path + ".segment", problem});
  const bool has_mass = load.mass > 0 && load.mass <= kHeaviest;
  if (!has_mass) {
    violations->push_back(
        {path + ".mass_kg", Text("is ", load.mass, " kg; must be more than 0 and at most ", kHeaviest, " kg")});
  }
  if (load.position && !(load.position->cwiseAbs().maxCoeff() <= kFurthest && load.position->allFinite())) {
    violations->push_back({path + ".position_m", Text("is (", Numbers(*load.position), ") m; each must be between -",
                                                      kFurthest, " and ", kFurthest, " m")});
  }
  const Vector3& m = load.moments;
  const bool is_body = m.allFinite() && m.minCoeff() >= 0 && 2 * m.maxCoeff() <= m.sum() * (1 + 1e-9);
  if (!is_body || (has_mass && m.maxCoeff() > load.mass * kFurthest * kFurthest)) {
    violations->push_back({path + ".moments_kg_m2",
                           Text("are (", Numbers(m), ") kg m²; each must be at least 0 and at most mass_kg times ",
                                kFurthest, " m², and the sum of any two at least the third")});
  }
  return violations->size() == before;
}

void AddLoad(const SegmentLoad& load, const Model& human, const SidedTables& tables, std::vector<Joint>* joints) {
  const SidedSegment at = *FindSegment(load.segment);
  const SegmentPlace place = PlaceOf(at.segment, at.side, tables.Of(at.side));
  Joint& joint = (*joints)[static_cast<size_t>(human.Find(place.joint))];
  const RigidBody carried{
      load.mass, load.position ? FromIsb(*load.position) : tables.Of(at.side).Body(at.segment, at.side).center_of_mass,
      FromIsb(load.moments).cwiseAbs().asDiagonal()};
  const RigidBody sum = Lumped({{joint.mass, joint.center_of_mass, joint.inertia}, Shifted(carried, place.origin)});
  joint.mass = sum.mass;
  joint.center_of_mass = sum.center_of_mass;
  joint.inertia = 0.5 * (sum.inertia + sum.inertia.transpose());
}

// A joint that moves and has muscles; null and a violation otherwise.
Joint* FindMuscled(const std::string& name, const std::string& field, const Model& human,
                   const std::map<std::string, double>& fixed, std::vector<Joint>* joints, Violations* violations) {
  const int joint = human.Find(name);
  std::vector<std::string> known;  // those that may be named
  for (const Joint& each : human.joints()) {
    if (each.actuated && fixed.count(each.name) == 0) known.push_back(each.name);
  }
  if (joint < 0) {
    violations->push_back({field, NoSuchJoint(name, known)});
  } else if (!human.joint(joint).actuated) {
    violations->push_back({field, "belongs to the floating base, which has no muscles; choose from " + Listed(known)});
  } else if (fixed.count(name) > 0) {
    violations->push_back({field,
                           "is of a joint that is fixed (locked_joints_rad, sagittal, drop_arms, rigid_trunk or "
                           "the model \"planar\"); leave one of the two out"});
  } else {
    return &(*joints)[static_cast<size_t>(joint)];
  }
  return nullptr;
}

bool CheckSpring(const JointSpring& spring, const std::string& path, Violations* violations) {
  const size_t before = violations->size();
  // In the unit of the field, and in degrees, in which people think of joints.
  const auto check = [&](const char* field, const char* unit, double value, double min, double max,
                         const char* unit_of_degrees, double per_degree) {
    if (IsWithin(value, min, max)) return;
    violations->push_back({path + field, Text("is ", value, " ", unit, " (", value * per_degree, " ", unit_of_degrees,
                                              "); must be between ", min, " and ", max, " ", unit, " (",
                                              min * per_degree, " and ", max * per_degree, " ", unit_of_degrees, ")")});
  };
  constexpr double kDegrees = 180 / std::numbers::pi;
  check(".stiffness_n_m_rad", "N m/rad", spring.stiffness, 0, kStiffest, "N m/deg", 1 / kDegrees);
  check(".rest_rad", "rad", spring.rest, -std::numbers::pi, std::numbers::pi, "deg", kDegrees);
  check(".damping_n_m_s_rad", "N m s/rad", spring.damping, 0, kThickest, "N m s/deg", 1 / kDegrees);
  return violations->size() == before;
}

// Names of surfaces that a request gives, by field.
struct NamedField {
  const char* field;
  const std::string& name;
};

// Visits the surfaces of these feet that have the name, of the side that it ends with or of both, as they are without
// what the request says of feet; `left` says of which side. The visit returns what is wrong, or nothing; one violation
// though both sides may refuse it. Violations name field["NAME"].
template <typename Visit>
void ForSurfaces(const NamedField& named, const BodySelection& selection, const SidedTables& tables,
                 Violations* violations, Visit visit) {
  const std::string& name = named.name;
  const std::string field = Keyed(named.field, name);
  const bool left = !name.ends_with("_r"), right = !name.ends_with("_l");
  const std::string part = left && right ? name : name.substr(0, name.size() - 2);
  std::vector<std::string> known;
  std::string problem;
  for (const bool on_left : {true, false}) {
    if (on_left ? !left : !right) continue;
    known.clear();
    for (const FootSurface& surface : FootSurfaces(on_left ? tables.left : tables.right, selection.feet)) {
      known.push_back(surface.name);
      if (surface.name != part) continue;
      const std::string wrong = visit(surface, on_left);
      if (problem.empty()) problem = wrong;
    }
  }
  if (std::find(known.begin(), known.end(), part) == known.end()) {
    problem = "is no surface of these feet" + DidYouMean(part, known) + "; choose from " + Listed(known) +
              " (see `feet`), with _l or _r that of one side";
  }
  if (!problem.empty()) violations->push_back({field, problem});
}

}  // namespace

std::string NoSuchJoint(const std::string& name, const std::vector<std::string>& known) {
  const std::string shown = name.substr(0, 40);
  return "the human has no joint of that name" + DidYouMean(shown, known) + "; choose from " + Listed(known);
}

SidedTables TablesOf(const BodySelection& selection, Violations* violations) {
  const SegmentTable table(selection.sex, selection.stature, selection.mass);
  SegmentScales left = kTableScales, right = kTableScales;
  // In the order of names: of a segment both sides before one of them.
  for (const auto& [name, length] : selection.segment_lengths) {
    const std::string field = Keyed("segment_lengths_m", name);
    const auto found = FindSegment(name);
    if (!found) {
      violations->push_back({field, "is not a segment" + DidYouMean(name, AllSegmentNames()) + "; choose from " +
                                        Listed(SegmentNames(false)) + "; with _l or _r a limb's of one side"});
      continue;
    }
    const Segment kind = found->segment;
    const double usual = kind == Segment::kFoot ? table.FootLength() : table.Length(kind);  // a foot from heel to toe
    if (!IsWithin(length, kShortest * usual, kLongest * usual)) {
      violations->push_back(
          {field, Text("is ", length, " m; must be between ", kShortest * usual, " and ", kLongest * usual, " m (",
                       kShortest, " and ", kLongest, " times the table's at this stature)")});
      continue;
    }
    if (found->side != BodySide::kRight) left[static_cast<size_t>(kind)] = length / usual;
    if (found->side != BodySide::kLeft) right[static_cast<size_t>(kind)] = length / usual;
  }
  return {SegmentTable(selection.sex, selection.stature, selection.mass, left),
          SegmentTable(selection.sex, selection.stature, selection.mass, right)};
}

SidedFeet FeetOf(const BodySelection& selection, const SidedTables& tables, Violations* violations) {
  const Vector3 least(kNarrowest, kNarrowest, kFlattest), most(kWidest, kWidest, kHighest);
  SidedFeet feet;
  // In the order of names: of a surface both sides before one of them.
  for (const auto& [name, axes] : selection.changes.foot_semi_axes) {
    ForSurfaces({"foot_semi_axes_m", name}, selection, tables, violations,
                [&, &axes = axes](const FootSurface& usual, bool left) {
                  const Vector3 low = usual.semi_axes.cwiseProduct(least), high = usual.semi_axes.cwiseProduct(most);
                  if ((axes.array() >= low.array()).all() && (axes.array() <= high.array()).all()) {
                    (left ? feet.left : feet.right)[usual.name].semi_axes = axes;
                    return std::string();
                  }
                  return Text("are (", Numbers(axes), ") m; must be between (", Numbers(low), ") and (", Numbers(high),
                              ") m: forward and left ", kNarrowest, " to ", kWidest, ", up ", kFlattest, " to ",
                              kHighest, " times what the lengths of foot and leg give");
                });
  }
  for (const auto& [name, exponent] : selection.changes.foot_exponents) {
    ForSurfaces({"foot_exponents", name}, selection, tables, violations,
                [&, exponent = exponent](const FootSurface& usual, bool left) {
                  if (IsWithin(exponent, kLeastFootExponent, kMostFootExponent)) {
                    (left ? feet.left : feet.right)[usual.name].exponent = exponent;
                    return std::string();
                  }
                  return Text("is ", exponent, "; must be between ", kLeastFootExponent, " and ", kMostFootExponent,
                              " (1 is the ellipsoid): ", exponent < kLeastFootExponent ? "boxier" : "more pointed",
                              " feet are not known to walk");
                });
  }
  return feet;
}

std::vector<Joint> ChangedJoints(const Model& human, const SidedTables& tables, const BodySelection& selection,
                                 const std::map<std::string, double>& fixed, Violations* violations) {
  const SubjectChanges& changes = selection.changes;
  std::vector<Joint> joints = human.joints();
  if (changes.loads.size() > kMostLoads) {
    violations->push_back({"loads", Text("are ", changes.loads.size(), "; at most ", kMostLoads, " are accepted")});
  } else {
    for (size_t i = 0; i < changes.loads.size(); ++i) {
      if (!CheckLoad(changes.loads[i], Text("loads[", i, "]"), violations)) continue;
      AddLoad(changes.loads[i], human, tables, &joints);
    }
  }
  for (const auto& [name, spring] : changes.springs) {
    const std::string field = Keyed("joint_springs", name);
    Joint* const joint = FindMuscled(name, field, human, fixed, &joints, violations);
    if (joint == nullptr || !CheckSpring(spring, field, violations)) continue;
    joint->stiffness = spring.stiffness;
    joint->rest_position = spring.rest;
    joint->damping = spring.damping;
  }
  for (const auto& [name, share] : changes.strengths) {
    const std::string field = Keyed("joint_strengths", name);
    Joint* const joint = FindMuscled(name, field, human, fixed, &joints, violations);
    if (joint == nullptr) continue;
    if (!IsWithin(share, 0, 1)) {
      violations->push_back({field, Text("is ", share, "; must be between 0 and 1, a share of the joint's effort")});
      continue;
    }
    joint->effort_min *= share;
    joint->effort_max *= share;
    if (share > 0) continue;
    joint->effort_min = joint->effort_max = 0;  // not −0
    joint->actuated = false;
    joint->passive = PassiveKind::kNone;
  }
  const auto is_driven = [&](const Joint& joint) { return joint.actuated && fixed.count(joint.name) == 0; };
  if (!changes.strengths.empty() && std::none_of(joints.begin(), joints.end(), is_driven)) {
    violations->push_back({"joint_strengths", "leave no joint that a muscle could move; leave at least one above 0"});
  }
  return joints;
}

}  // namespace rollgait
