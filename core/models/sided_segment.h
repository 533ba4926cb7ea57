#ifndef ROLLGAIT_CORE_MODELS_SIDED_SEGMENT_H_
#define ROLLGAIT_CORE_MODELS_SIDED_SEGMENT_H_

#include <optional>
#include <string>
#include <vector>

#include "core/models/segment_table.h"

namespace rollgait {

struct SidedSegment {
  Segment segment;
  BodySide side;  // kMidline: of head, torso and pelvis; of a limb both
};

// The segment of a name: "thigh", "thigh_l", "torso"; empty if there is none of that name.
std::optional<SidedSegment> FindSegment(const std::string& name);

// The name of a segment on its side.
std::string NameOf(const SidedSegment& at);

// All names, for messages; `sided`: those of limbs with each side, else without.
std::vector<std::string> SegmentNames(bool sided);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SIDED_SEGMENT_H_
