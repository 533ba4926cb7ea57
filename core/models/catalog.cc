#include "core/models/catalog.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "core/models/human_scene.h"
#include "core/models/own_model.h"
#include "core/models/rolling_ellipsoid.h"
#include "core/models/segment_table.h"

namespace rollgait {
namespace {

// What a row says of a human.
struct HumanDefaults {
  bool sagittal = false, drop_arms = false, rigid_trunk = false;  // whatever the request says
  JointRanges ranges = JointRanges::kAnatomical;                  // of a request that leaves them unset
};

constexpr double kStatureMin = 1.0, kStatureMax = 2.3;  // m
constexpr double kMassMin = 20, kMassMax = 250;         // kg

void CheckRange(const char* field, const char* unit, double value, double min, double max, Violations* violations) {
  if (value >= min && value <= max) return;  // false for NaN
  std::ostringstream message;
  message << "is " << value << " " << unit << "; must be between " << min << " and " << max << " " << unit;
  violations->push_back({field, message.str()});
}

// What describes a human and was given for something else.
Violations RefuseHumanFields(const BodyRequest& request, const std::string& what) {
  Violations violations;
  const auto refuse = [&](bool given, const char* field) {
    if (given) violations.push_back({field, "means nothing for " + what + "; leave it out"});
  };
  refuse(request.stature.has_value(), "stature_m");
  refuse(request.mass.has_value(), "body_mass_kg");
  refuse(!request.segment_lengths.empty(), "segment_lengths_m");
  refuse(request.feet.has_value(), "feet");
  refuse(request.toes, "toes");
  refuse(request.sagittal, "sagittal");
  refuse(request.drop_arms, "drop_arms");
  refuse(request.rigid_trunk, "rigid_trunk");
  refuse(!request.locked_joints.empty(), "locked_joints_rad");
  refuse(!request.changes.loads.empty(), "loads");
  refuse(!request.changes.strengths.empty(), "joint_strengths");
  refuse(!request.changes.springs.empty(), "joint_springs");
  refuse(!request.changes.foot_semi_axes.empty(), "foot_semi_axes_m");
  refuse(!request.changes.foot_exponents.empty(), "foot_exponents");
  refuse(request.ranges.has_value(), "ranges");
  return violations;
}

Result<Scene> BuildBall(const BodyRequest& request, const HumanDefaults&) {
  Violations violations = RefuseHumanFields(request, "model \"" + request.model + "\"");
  Result<Scene> scene = RollingEllipsoidScene(request.rolling_body.value_or(RollingEllipsoidRequest()), {});
  if (violations.empty()) return scene;
  if (!scene.ok()) violations.insert(violations.end(), scene.violations().begin(), scene.violations().end());
  return violations;
}

Result<Scene> BuildOwn(const BodyRequest& request) {
  Violations violations = RefuseHumanFields(request, "a model of your own");
  if (!request.model.empty() && request.model != request.own->name) {
    violations.push_back({"name", "is not own.summary.name; leave it out"});
  }
  if (request.sex != Sex::kMale) violations.push_back({"sex", "means nothing for a model of your own; leave it out"});
  if (request.rolling_body) {
    violations.push_back({"rolling_body", "means nothing for a model of your own; leave it out"});
  }
  Result<Scene> scene = OwnScene(*request.own);
  if (!scene.ok()) {
    for (const Violation& violation : scene.violations()) {
      violations.push_back({"own." + violation.field, violation.message});
    }
  }
  if (!violations.empty()) return violations;
  return scene;
}

double StatureOf(const BodyRequest& request) { return request.stature.value_or(DefaultStature(request.sex)); }

double MassOf(const BodyRequest& request) { return request.mass.value_or(DefaultMass(request.sex)); }

Violations CheckHuman(const BodyRequest& request) {
  Violations violations;
  if (request.rolling_body) violations.push_back({"rolling_body", "is for model \"ball\" only; leave it out"});
  CheckRange("stature_m", "m", StatureOf(request), kStatureMin, kStatureMax, &violations);
  CheckRange("body_mass_kg", "kg", MassOf(request), kMassMin, kMassMax, &violations);
  return violations;
}

Result<Scene> BuildHuman(const BodyRequest& request, const HumanDefaults& defaults) {
  const Violations violations = CheckHuman(request);
  if (!violations.empty()) return violations;
  const BodySelection selection{
      .model = request.model,
      .sex = request.sex,
      .stature = StatureOf(request),
      .mass = MassOf(request),
      .segment_lengths = request.segment_lengths,
      .changes = request.changes,
      .feet = request.feet.value_or(request.toes ? FootShape::kTwoEllipsoids : FootShape::kOneEllipsoid),
      .toes = request.toes,
      .ranges = request.ranges.value_or(defaults.ranges),
      .sagittal = request.sagittal || defaults.sagittal,
      .drop_arms = request.drop_arms || defaults.drop_arms,
      .rigid_trunk = request.rigid_trunk || defaults.rigid_trunk,
      .locked_joints = request.locked_joints,
      .rolling_body = {},
  };
  return HumanScene(selection);
}

struct Entry {
  const char* name;
  const char* description;  // "": the scene has its own
  Result<Scene> (*build)(const BodyRequest& request, const HumanDefaults& human);
  HumanDefaults human = {};
};
// Every model of the server, one row each.
constexpr Entry kEntries[] = {
    {"planar",
     "Human in the sagittal plane: rigid trunk, hips, knees, ankles; ellipsoidal feet that roll.",
     BuildHuman,
     {.sagittal = true, .drop_arms = true, .rigid_trunk = true}},
    {"planar_arms",
     "Human in the sagittal plane with arms: rigid trunk, shoulders, elbows, hips, knees, ankles; ellipsoidal feet "
     "that roll.",
     BuildHuman,
     {.sagittal = true, .rigid_trunk = true, .ranges = JointRanges::kWalking}},
    {"human29",
     "Human in space: pelvis, trunk, arms, legs and ellipsoidal feet that roll.",
     BuildHuman,
     {.ranges = JointRanges::kWalking}},
    {"ball", "", BuildBall},
};

std::string UnknownModel(const std::string& name) {
  std::string message = name.empty() ? "is empty" : "\"" + name + "\" is not a model of this server";
  message += "; choose one of:";
  for (const Entry& entry : kEntries) message += std::string(" \"") + entry.name + "\"";
  return message;
}

}  // namespace

std::vector<CatalogEntry> ListCatalog() {
  std::vector<CatalogEntry> entries;
  for (const Entry& row : kEntries) {
    BodyRequest request;
    request.model = row.name;
    const Result<Scene> scene = BuildScene(request);
    ROLLGAIT_CHECK(scene.ok());
    const Model& model = scene.value().model;
    CatalogEntry entry{
        row.name, scene.value().description, model.size(), static_cast<int>(model.actuated().size()), {}};
    for (const ContactSurface& contact : scene.value().contacts) entry.contacts.push_back(contact.name);
    entries.push_back(entry);
  }
  return entries;
}

Result<Scene> BuildScene(const BodyRequest& request) {
  if (request.own) return BuildOwn(request);
  const auto* const entry = std::find_if(std::begin(kEntries), std::end(kEntries),
                                         [&](const Entry& row) { return request.model == row.name; });
  if (entry == std::end(kEntries)) {
    Violations violations = CheckHuman(request);
    violations.insert(violations.begin(), {"name", UnknownModel(request.model)});
    return violations;
  }
  Result<Scene> scene = entry->build(request, entry->human);
  if (!scene.ok() || *entry->description == '\0') return scene;
  Scene described = std::move(scene).value();
  described.description = entry->description;
  return described;
}

}  // namespace rollgait
