#ifndef ROLLGAIT_CORE_MODELS_LIMB_BODIES_H_
#define ROLLGAIT_CORE_MODELS_LIMB_BODIES_H_

#include <string>
#include <vector>

#include "core/contact/body_surface.h"
#include "core/contact/contact_surface.h"
#include "core/models/segment_table.h"

namespace rollgait {

// The thickness of limbs. Ellipsoids whose axes are those of the straight hanging limb (forward, left, up), `center` in
// m from the joint centre at the upper end of the segment. Thickness is proportional to stature, length to the length
// of the segment; neither depends on the mass of the body, so that bodies of different mass and equal size walk alike.
struct LimbBody {
  Surface surface;
  Vector3 center;
};
LimbBody ThighBody(const SegmentTable& table);    // from the hip: from 0.15 to 1.15 times the length of the thigh
LimbBody ShankBody(const SegmentTable& table);    // from the knee: a tenth of its length beyond knee and ankle
LimbBody ForearmBody(const SegmentTable& table);  // from the elbow to the knuckles
LimbBody InstepBody(const SegmentTable& table);   // from the ankle: between heel and toe joint, on the sole

// Which part of a limb a body stands for: decides what it can meet.
enum class LimbPart { kFoot, kShank, kThigh, kForearm };
struct LimbSurface {
  LimbPart part;
  BodySide side;  // kLeft or kRight
  BodySurface body;
};

// The pairs that can meet, first the left body where sides differ: every body of one leg with every body of the other,
// each forearm with both thighs, and the two forearms. Left and right are mirror images of each other. The bodies of
// one leg are no pairs: the ranges of their joints keep them apart, or they share a joint. Usual are, of feet, shanks
// and thighs, the widest body and its mirror image: legs that swing past each other meet there first (measured on -20
// to 20 degrees, docs/explanation/walking.md). Contract: `surfaces` with their mirror bodies set.
std::vector<BodyPair> LimbPairs(const std::vector<LimbSurface>& surfaces);

// Where the numbers come from.
std::vector<std::string> LimbBodySources();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_LIMB_BODIES_H_
