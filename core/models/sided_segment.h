#ifndef ROLLGAIT_CORE_MODELS_SIDED_SEGMENT_H_
#define ROLLGAIT_CORE_MODELS_SIDED_SEGMENT_H_

#include <optional>
#include <string>

#include "core/models/segment_table.h"

namespace rollgait {

struct SidedSegment {
  Segment segment;
  BodySide side;  // kMidline: of head, torso and pelvis; of a limb both
};

// The segment of a name: "thigh", "thigh_l", "torso"; empty if there is none of that name.
std::optional<SidedSegment> FindSegment(const std::string& name);

// The name of a segment on its side, and of its mirror image; the same of head, torso, pelvis and both sides of a limb.
std::string NameOf(const SidedSegment& at);
std::string MirrorNameOf(const SidedSegment& at);

// All names with spaces and commas, for messages; `sided`: those of limbs with each side, else without.
std::string SegmentNames(bool sided);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SIDED_SEGMENT_H_
