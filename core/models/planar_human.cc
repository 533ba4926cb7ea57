#include "core/models/planar_human.h"

#include <utility>

#include "core/base/check.h"
#include "core/models/catalog.h"

namespace rollgait {

Scene PlanarHuman(Sex sex, double stature, double mass) {
  BodyRequest request;
  request.model = "planar";
  request.sex = sex;
  request.stature = stature;
  request.mass = mass;
  Result<Scene> scene = BuildScene(request);
  ROLLGAIT_CHECK(scene.ok());
  return std::move(scene).value();
}

}  // namespace rollgait
