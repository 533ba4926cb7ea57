#include "core/models/limb_bodies.h"

#include "core/base/check.h"

namespace rollgait {
namespace {

// Radii over stature. Circumferences of the US Army survey of 1988, means of men of 1.756 m (from memory): calf 378 mm,
// knee 386 mm, ankle 222 mm, forearm 300 mm; women have the same ratios within 3 %.
constexpr double kShankRadius = 0.0343, kThighRadius = 0.0375;
constexpr double kForearmDepth = 0.0245, kForearmBreadth = 0.021;
// Half lengths and centres over the length of the segment.
constexpr double kShankHalfLength = 0.6, kThighHalfLength = 0.5, kThighCenter = 0.65;
// From the wrist to the knuckles of the bent fingers, over the distance from the wrist to the metacarpal heads.
constexpr double kHandReach = 1.6;
// Instep over foot length: middle from the heel, half length, half breadth, half height.
constexpr double kInstepCenter = 0.375, kInstepHalfLength = 0.33, kInstepHalfBreadth = 0.14, kInstepHalfHeight = 0.13;

bool IsLeg(LimbPart part) { return part != LimbPart::kForearm; }

// The left one of two bodies is `a`, or both are of one side.
bool CanMeet(const LimbSurface& a, const LimbSurface& b) {
  if (a.side == b.side) return a.part == LimbPart::kThigh && b.part == LimbPart::kForearm;
  if (IsLeg(a.part) && IsLeg(b.part)) return true;
  return (IsLeg(a.part) ? a.part : b.part) == LimbPart::kThigh || a.part == b.part;
}

}  // namespace

LimbBody ThighBody(const SegmentTable& table) {
  const double length = table.Length(Segment::kThigh), radius = kThighRadius * table.stature();
  return {Ellipsoid(Vector3(radius, radius, kThighHalfLength * length)), Vector3(0, 0, -kThighCenter * length)};
}

LimbBody ShankBody(const SegmentTable& table) {
  const double length = table.Length(Segment::kShank), radius = kShankRadius * table.stature();
  return {Ellipsoid(Vector3(radius, radius, kShankHalfLength * length)), Vector3(0, 0, -length / 2)};
}

LimbBody ForearmBody(const SegmentTable& table) {
  const double half_length = (table.Length(Segment::kForearm) + kHandReach * table.Length(Segment::kHand)) / 2;
  return {Ellipsoid(Vector3(kForearmDepth * table.stature(), kForearmBreadth * table.stature(), half_length)),
          Vector3(0, 0, -half_length)};
}

LimbBody InstepBody(const SegmentTable& table) {
  const Vector3 semi_axes = table.FootLength() * Vector3(kInstepHalfLength, kInstepHalfBreadth, kInstepHalfHeight);
  return {Ellipsoid(semi_axes),
          Vector3(kInstepCenter * table.FootLength() - table.HeelToAnkle(), 0, semi_axes.z() - table.AnkleHeight())};
}

std::vector<BodyPair> LimbPairs(const std::vector<LimbSurface>& surfaces) {
  const int count = static_cast<int>(surfaces.size());
  std::vector<BodyPair> pairs;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < count; ++k) {
      const bool ordered = surfaces[i].side == BodySide::kLeft || surfaces[k].side == surfaces[i].side;
      if (i != k && ordered && CanMeet(surfaces[i], surfaces[k])) pairs.push_back({i, k, -1});
    }
  }
  for (BodyPair& pair : pairs) {
    const int first = surfaces[pair.first].body.mirror_body, second = surfaces[pair.second].body.mirror_body;
    for (size_t image = 0; image < pairs.size(); ++image) {
      const bool same = pairs[image].first == first && pairs[image].second == second;
      const bool swapped = pairs[image].first == second && pairs[image].second == first;
      if (same || swapped) pair.mirror_pair = static_cast<int>(image);
    }
    ROLLGAIT_CHECK(pair.mirror_pair >= 0);
  }
  const auto half_width = [&](const BodyPair& pair) {
    const PlacedSurface& placed = surfaces[pair.first].body.placed;
    return placed.surface.Support(placed.R_BE.transpose() * Vector3::UnitY());
  };
  for (const LimbPart part : {LimbPart::kFoot, LimbPart::kShank, LimbPart::kThigh}) {
    BodyPair* widest = nullptr;
    for (BodyPair& pair : pairs) {
      if (surfaces[pair.first].part != part || surfaces[pair.first].body.mirror_body != pair.second) continue;
      if (widest == nullptr || half_width(pair) > half_width(*widest)) widest = &pair;
    }
    if (widest != nullptr) widest->usual = true;
  }
  return pairs;
}

std::vector<std::string> LimbBodySources() {
  return {
      "Bodies of the limbs: ellipsoids, thickness proportional to stature. Shank: radius 0.0343 of stature (calf "
      "circumference "
      "378 mm at 1.756 m, US Army survey of 1988, men, from memory), 0.55 of it at knee and ankle (ankle circumference "
      "222 mm: "
      "0.59). Thigh: its lower part, radius 0.0375 of stature, 0.71 of it at the knee (people: knee circumference 386 "
      "mm, "
      "radius 0.035 of stature; mid-thigh 0.047): a fifth thinner than people's, whose thighs touch and yield.",
      "Forearm with hand: half thickness 0.0245 (fore and aft) and 0.021 (sideways) of stature (forearm circumference "
      "300 mm, "
      "from memory), from the elbow to the knuckles of the bent fingers, 1.6 times the way to the metacarpal heads. "
      "Instep of a foot of two ellipsoids: half breadth 0.14, height 0.26 of the foot length (chosen).",
  };
}

}  // namespace rollgait
