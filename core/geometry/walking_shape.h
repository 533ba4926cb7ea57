#ifndef ROLLGAIT_CORE_GEOMETRY_WALKING_SHAPE_H_
#define ROLLGAIT_CORE_GEOMETRY_WALKING_SHAPE_H_

#include <functional>
#include <vector>

#include "core/base/types.h"

namespace rollgait {

// What a kind of surface says of itself if bodies that walk may have it: its member Walking() gives this, kWalks names
// it in a sentence, semi_axes() refers to the semi-axes. Such a body is symmetric about its centre and has four
// derivatives at every normal.
struct WalkingShape {
  const char* field;  // of the oneof in rollgait.v1.Surface
  Vector3 semi_axes;  // m, half the box around the body
  // Its other numbers, and how large they may be in a body that walks.
  struct Number {
    const char* field;  // of the shape's message
    double value, least, most;
  };
  std::vector<Number> numbers;
  // The support function in m for any vector, written anew from its definition: what judges shares no code with what
  // is judged. Of an ellipsoid empty: that is ‖semi_axes · ν‖.
  std::function<double(const Vector3&)> support;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_WALKING_SHAPE_H_
