#include "core/models/sided_segment.h"

namespace rollgait {

std::string NameOf(const SidedSegment& at) {
  const std::string name = SegmentName(at.segment);
  return at.side == BodySide::kMidline ? name : name + (at.side == BodySide::kLeft ? "_l" : "_r");
}

std::optional<SidedSegment> FindSegment(const std::string& name) {
  for (int s = 0; s < kSegments; ++s) {
    const Segment segment = static_cast<Segment>(s);
    for (const BodySide side : {BodySide::kMidline, BodySide::kLeft, BodySide::kRight}) {
      const SidedSegment at{segment, side};
      if ((side == BodySide::kMidline || IsPaired(segment)) && name == NameOf(at)) return at;
    }
  }
  return std::nullopt;
}

std::vector<std::string> SegmentNames(bool sided) {
  std::vector<std::string> names;
  for (int s = 0; s < kSegments; ++s) {
    const Segment segment = static_cast<Segment>(s);
    if (sided && IsPaired(segment)) {
      names.push_back(NameOf({segment, BodySide::kLeft}));
      names.push_back(NameOf({segment, BodySide::kRight}));
    } else {
      names.push_back(SegmentName(segment));
    }
  }
  return names;
}

}  // namespace rollgait
