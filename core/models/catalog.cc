#include "core/models/catalog.h"

#include <sstream>

#include "core/models/planar_human.h"
#include "core/models/segment_table.h"

namespace rollgait {
namespace {

struct Maker {
  const char* name;
  Scene (*make)(Sex sex, double stature, double mass);
};
// Every model there is.
constexpr Maker kMakers[] = {{"planar", PlanarHuman}};

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
  for (const Maker& maker : kMakers) message += std::string(" \"") + maker.name + "\"";
  return message;
}

}  // namespace

std::vector<CatalogEntry> ListCatalog() {
  std::vector<CatalogEntry> entries;
  for (const Maker& maker : kMakers) {
    const Scene scene = maker.make(Sex::kMale, DefaultStature(Sex::kMale), DefaultMass(Sex::kMale));
    CatalogEntry entry{scene.name, scene.description, scene.model.size(),
                       static_cast<int>(scene.model.actuated().size()), {}};
    for (const ContactSurface& contact : scene.contacts) entry.contacts.push_back(contact.name);
    entries.push_back(entry);
  }
  return entries;
}

Result<Scene> BuildScene(const BodyRequest& request) {
  Violations violations;
  const Maker* chosen = nullptr;
  for (const Maker& maker : kMakers) {
    if (request.model == maker.name) chosen = &maker;
  }
  if (chosen == nullptr) violations.push_back({"name", UnknownModel(request.model)});
  const double stature = request.stature.value_or(DefaultStature(request.sex));
  const double mass = request.mass.value_or(DefaultMass(request.sex));
  CheckRange("stature_m", "m", stature, kStatureMin, kStatureMax, &violations);
  CheckRange("body_mass_kg", "kg", mass, kMassMin, kMassMax, &violations);
  if (!violations.empty()) return violations;
  return chosen->make(request.sex, stature, mass);
}

}  // namespace rollgait
