#ifndef ROLLGAIT_CORE_MODELS_CATALOG_H_
#define ROLLGAIT_CORE_MODELS_CATALOG_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/models/scene.h"

namespace rollgait {

struct CatalogEntry {
  std::string name;
  std::string description;
  int degrees_of_freedom;
  int actuated_joints;
  std::vector<std::string> contacts;
};

// The request for a body before it is checked; empty optionals take the defaults of rollgait.v1.ModelSelection.
struct BodyRequest {
  std::string model;
  Sex sex = Sex::kMale;
  std::optional<double> stature;  // m, [1.0, 2.3]
  std::optional<double> mass;     // kg, [20, 250]
};

// Every model there is, in the order of the catalogue.
std::vector<CatalogEntry> ListCatalog();

// Builds the scaled scene. Violations name "name", "stature_m", "body_mass_kg".
Result<Scene> BuildScene(const BodyRequest& request);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_CATALOG_H_
