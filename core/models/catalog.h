#ifndef ROLLGAIT_CORE_MODELS_CATALOG_H_
#define ROLLGAIT_CORE_MODELS_CATALOG_H_

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

// Every model there is, in the order of the catalogue.
std::vector<CatalogEntry> ListCatalog();

// Builds the scaled and reduced scene. Violations name fields of rollgait.v1.ModelSelection: "name", "stature_m",
// "body_mass_kg" those of HumanScene, and "own." with those of OwnScene.
Result<Scene> BuildScene(const BodyRequest& request);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_CATALOG_H_
