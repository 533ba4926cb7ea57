#include "core/models/catalog.h"

#include <sstream>
#include <utility>

#include "core/models/human_scene.h"
#include "core/models/segment_table.h"

namespace rollgait {
namespace {

struct Entry {
  const char* name;
  const char* description;
  bool planar;  // sagittal, without arms and with a rigid trunk
  JointRanges ranges;  // by default
};
// Every model there is. All are the one human, reduced.
constexpr Entry kEntries[] = {
    {"planar", "Human in the sagittal plane: rigid trunk, hips, knees, ankles; ellipsoidal feet that roll.", true,
     JointRanges::kAnatomical},
    {"human29", "Human in space: pelvis, trunk, arms, legs and ellipsoidal feet that roll.", false, JointRanges::kWalking},
};

constexpr double kStatureMin = 1.0, kStatureMax = 2.3;  // m
constexpr double kMassMin = 20, kMassMax = 250;         // kg

void CheckRange(const char* field, const char* unit, double value, double min, double max, Violations* violations) {
  if (value >= min && value <= max) return;  // false for NaN
  std::ostringstream message;
  message << "is " << value << " " << unit << "; must be between " << min << " and " << max << " " << unit;
  violations->push_back({field, message.str()});
}

std::string UnknownModel(const std::string& name) {
  std::string message = name.empty() ? "is empty" : "\"" + name + "\" is not a model of this server";
  message += "; choose one of:";
  for (const Entry& entry : kEntries) message += std::string(" \"") + entry.name + "\"";
  return message;
}

}  // namespace

std::vector<CatalogEntry> ListCatalog() {
  std::vector<CatalogEntry> entries;
  for (const Entry& known : kEntries) {
    BodyRequest request;
    request.model = known.name;
    const Result<Scene> scene = BuildScene(request);
    ROLLGAIT_CHECK(scene.ok());
    const Model& model = scene.value().model;
    CatalogEntry entry{known.name, known.description, model.size(), static_cast<int>(model.actuated().size()), {}};
    for (const ContactSurface& contact : scene.value().contacts) entry.contacts.push_back(contact.name);
    entries.push_back(entry);
  }
  return entries;
}

Result<Scene> BuildScene(const BodyRequest& request) {
  Violations violations;
  const Entry* chosen = nullptr;
  for (const Entry& entry : kEntries) {
    if (request.model == entry.name) chosen = &entry;
  }
  if (chosen == nullptr) violations.push_back({"name", UnknownModel(request.model)});
  const bool planar = chosen != nullptr && chosen->planar;
  const BodySelection selection{
      .model = request.model,
      .sex = request.sex,
      .stature = request.stature.value_or(DefaultStature(request.sex)),
      .mass = request.mass.value_or(DefaultMass(request.sex)),
      .segment_lengths = request.segment_lengths,
      .feet = request.feet.value_or(request.toes ? FootShape::kTwoEllipsoids : FootShape::kOneEllipsoid),
      .toes = request.toes,
      .ranges = request.ranges.value_or(chosen == nullptr ? JointRanges::kAnatomical : chosen->ranges),
      .sagittal = request.sagittal || planar,
      .drop_arms = request.drop_arms || planar,
      .rigid_trunk = request.rigid_trunk || planar,
      .locked_joints = request.locked_joints,
  };
  CheckRange("stature_m", "m", selection.stature, kStatureMin, kStatureMax, &violations);
  CheckRange("body_mass_kg", "kg", selection.mass, kMassMin, kMassMax, &violations);
  if (!violations.empty()) return violations;
  Result<Scene> scene = HumanScene(selection);
  if (!scene.ok()) return scene;
  Scene described = std::move(scene).value();
  described.description = chosen->description;
  return described;
}

}  // namespace rollgait
