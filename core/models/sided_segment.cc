#include "core/models/sided_segment.h"

namespace rollgait {

std::string NameOf(const SidedSegment& at) {
  const std::string name = SegmentName(at.segment);
  return at.side == BodySide::kMidline ? name : name + (at.side == BodySide::kLeft ? "_l" : "_r");
}

std::string MirrorNameOf(const SidedSegment& at) {
  SidedSegment image = at;
  if (at.side != BodySide::kMidline) image.side = at.side == BodySide::kLeft ? BodySide::kRight : BodySide::kLeft;
  return NameOf(image);
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

std::string SegmentNames(bool sided) {
  std::string names;
  for (int s = 0; s < kSegments; ++s) {
    const Segment segment = static_cast<Segment>(s);
    names += s == 0 ? " " : ", ";
    names += sided && IsPaired(segment)
                 ? NameOf({segment, BodySide::kLeft}) + ", " + NameOf({segment, BodySide::kRight})
                 : SegmentName(segment);
  }
  return names;
}

}  // namespace rollgait
